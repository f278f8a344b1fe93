// SPDX-License-Identifier: Apache-2.0
// The demonstration with a lever that taps: one approach and retract by the simulated hand, and its files.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "servo/session_file.h"
#include "support/places.h"
#include "support/read_png.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace demo_tapping_test {

using ::testing::HasSubstr;

const std::string kTapping = " --mode tapping --free-amplitude 20nm ";
const std::string kLever = " --spring-constant 40N/m --resonance 300kHz --quality-factor 400 ";

support::ProgramResult demo(const std::string& out, const std::string& options) {
  return support::run_program(support::touchafm() + " demo --out " + out + " --language en --servo " +
                              support::servo_mode() + " " + options);
}

TEST(DemoInTapping, FeelsBothJumpsAndTheLoopOfTheAmplitude) {
  const support::ScratchFolder folder;
  const std::string options = kTapping + kLever + "--material gold --hand-speed 150mm/s --eye-width 160 --sound";
  support::ProgramResult result = demo(folder.path(), options);
  // a stalled virtual machine makes the servo release the hand repeatedly: tries again, as a person would
  for (int more = 0; more < 2 && result.err.find("reduce the load on this machine") != std::string::npos; ++more)
    result = demo(folder.path(), options);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("jump to the repulsive state"));
  EXPECT_THAT(result.err, HasSubstr("jump to the attractive state"));
  const nlohmann::json gold =
      nlohmann::json::parse(core::read_file(folder.file("summary.json")).value())["materials"]["gold"];
  EXPECT_THAT(gold["law"].get<std::string>(), ::testing::StartsWith("tapping-"));
  ASSERT_EQ(gold["jumps"].size(), 2U);
  const nlohmann::json &in = gold["jumps"][0], &out = gold["jumps"][1];
  EXPECT_GT(in["before"]["phase_deg"], 95.0);
  EXPECT_LT(in["after"]["phase_deg"], 85.0);
  EXPECT_LT(out["before"]["phase_deg"], 88.0);
  EXPECT_GT(out["after"]["phase_deg"], 92.0);
  EXPECT_GT(out["z_m"].get<double>(), in["z_m"].get<double>() + 0.5e-9);
  EXPECT_GT(gold["loop_energy_J"].get<double>(), 0.0);
  EXPECT_LT(gold["loop_of_amplitude_reduction_m2"].get<double>(), -0.2e-18) << "takes energy from the hand";
  EXPECT_TRUE(gold["work_on_hand_by_mean_force_J"].is_number());

  const auto session = servo::load_session(folder.file("session-gold.afms"));
  ASSERT_TRUE(session) << session.error().message;
  EXPECT_NE(session->find(physics::EventKind::JumpToRepulsion), nullptr);
  const std::string csv = core::read_file(folder.file("curve-gold.csv")).value();
  EXPECT_THAT(csv, HasSubstr(",amplitude_m,phase_deg,"));
  EXPECT_TRUE(curves::parse_curve(csv, "gold"));
  EXPECT_TRUE(std::filesystem::exists(folder.file("sound-gold.wav")));
  for (const char* name : {"choosing.png", "fig5a.png", "fig5b.png", "fig5c.png", "fig5d.png", "fig5e.png"})
    EXPECT_TRUE(support::read_png(folder.file(name))) << name;
  const std::string html = core::read_file(folder.file("report.html")).value();
  EXPECT_THAT(html, HasSubstr("(a) The swing has fallen into the repulsive state"));
  EXPECT_THAT(html, HasSubstr("amplitude A, zero-to-peak (nm)"));
}

TEST(DemoInTapping, RefusesWhatCannotBeTappedBeforeAnythingMoves) {
  const support::ScratchFolder folder;
  const auto refused = [&](const std::string& options, const std::string& why) {
    const auto result = demo(folder.file("none"), options);
    EXPECT_EQ(result.exit_code, 2) << options << result.err;
    EXPECT_THAT(result.err, HasSubstr(why)) << options;
  };
  refused("--mode tapping", "--mode tapping needs --free-amplitude");
  refused("--free-amplitude 20nm", "--free-amplitude has no effect on --mode contact");
  refused("--quality-factor 400", "--quality-factor has no effect on --mode contact");
  refused(kTapping + kLever + "--model paper", "needs the force as a function of the tip's height");
  refused(kTapping + kLever + "--vary hamaker=20zJ:40zJ:2", "--vary");
  refused(kTapping + kLever + "--friction amontons", "--friction");
  refused(kTapping + kLever + "--drive 318kHz --material mica",
          "mica cannot be felt: with the drive 6 % above the resonance this sample enlarges the swing from 20 nm");
  refused(kTapping + "--spring-constant 40N/m --resonance 3kHz --quality-factor 400", "--quality-factor");
  EXPECT_FALSE(std::filesystem::exists(folder.file("none")));
}

}  // namespace demo_tapping_test
}  // namespace afm::app
