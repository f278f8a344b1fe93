// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "physics/contact.h"
#include "scene/samples/material_library.h"
#include "servo/session_file.h"
#include "support/places.h"
#include "support/read_png.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

// The main job from the command line to its last file, once, at a fast hand and a small picture.
namespace afm::app {
namespace demo_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class Demo : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new support::ScratchFolder;
    const std::string command = support::touchafm() + " demo --out " + folder_->path() +
                                " --language en --hand-speed 120mm/s --eye-width 320 --servo " + support::servo_mode();
    result_ = new support::ProgramResult(support::run_program(command));
    // a stalled virtual machine makes the servo release the hand repeatedly: tries again, as a person would
    for (int more = 0; more < 2 && gave_up_for_load(*result_); ++more) *result_ = support::run_program(command);
  }
  static bool gave_up_for_load(const support::ProgramResult& result) {
    return result.exit_code == 1 && result.err.find("reduce the load on this machine") != std::string::npos;
  }
  static void TearDownTestSuite() {
    delete result_;
    delete folder_;
  }

  static nlohmann::json summary() {
    return nlohmann::json::parse(core::read_file(folder_->file("summary.json")).value());
  }

  static inline support::ScratchFolder* folder_ = nullptr;
  static inline support::ProgramResult* result_ = nullptr;
};

TEST_F(Demo, EndsWellAndSaysWhatToOpen) {
  EXPECT_EQ(result_->exit_code, 0) << result_->err;
  EXPECT_EQ(result_->out, "open " + folder_->path() + "/report.html\n");
  EXPECT_THAT(result_->err, HasSubstr("jump to contact"));
}

TEST_F(Demo, MeetsTheEquationsWithinATenthOfAPercent) {
  const auto materials =
      scene::load_materials(support::source("assets/materials.toml")).value().only(scene::kPaperMaterials).value();
  const nlohmann::json all = summary();
  for (const scene::MaterialEntry& material : materials.materials) {
    const auto events = physics::approach_retract_events(material.contact);
    const nlohmann::json& m = all["materials"][material.name];
    EXPECT_EQ(m["sources"]["tip_radius"]["source"], "Liu & Peng, Table 1") << material.name;
    EXPECT_NEAR(m["f_attr_N"].get<double>() / events.f_attr.si, 1.0, 1e-3) << material.name;
    EXPECT_NEAR(m["f_ad_N"].get<double>() / events.f_ad.si, 1.0, 1e-3) << material.name;
    EXPECT_NEAR(m["z_jtc_m"].get<double>() / events.z_jtc.si, 1.0, 1e-3) << material.name;
    EXPECT_NEAR(m["z_joc_m"].get<double>() / events.z_joc.si, 1.0, 1e-3) << material.name;
    EXPECT_LE(std::abs(m["error_vs_calculation"]["f_attr"].get<double>()), 1e-3) << material.name;
  }
}

TEST_F(Demo, ReportsTheServosTimingAndTheFrames) {
  const nlohmann::json all = summary();
  EXPECT_EQ(all["servo"]["rate_hz"], 1000.0);
  EXPECT_GT(all["servo"]["ticks"].get<int>(), 3000);
  for (const char* key : {"p50", "p99", "p99.9", "max"}) {
    EXPECT_TRUE(all["servo"]["wake_us"].contains(key));
    EXPECT_TRUE(all["servo"]["work_us"].contains(key));
    EXPECT_GT(all["frames"]["ms"][key].get<double>(), 0.0);
  }
  EXPECT_GT(all["frames"]["count"].get<int>(), 10);
  EXPECT_EQ(all["servo"]["lost_samples"], 0);
}

TEST_F(Demo, DrawsTheJourneyAsAFilmStripOfTen) {
  const auto strip = support::read_png(folder_->file("journey.png"));
  ASSERT_TRUE(strip.has_value());
  EXPECT_EQ(strip->width, 5U * 1440U / 4U);
  EXPECT_EQ(strip->height, 2U * 1080U / 4U);
}

TEST_F(Demo, DrawsEveryPictureSideBySideAndNoneIsEmpty) {
  for (const char* name : {"fig5a.png", "fig5b.png", "fig5c.png", "fig5d.png", "fig5e.png"}) {
    const auto image = support::read_png(folder_->file(name));
    ASSERT_TRUE(image.has_value()) << name;
    EXPECT_EQ(image->width, 2U * 1440U);
    EXPECT_EQ(image->height, 1080U);
    // a picture has dark and bright pixels, and the eyes differ
    std::size_t bright = 0, differing = 0;
    for (std::uint32_t y = 0; y < image->height; ++y) {
      for (std::uint32_t x = 0; x < 1440; ++x) {
        const std::size_t left = 4 * (std::size_t{y} * image->width + x);
        const std::size_t right = left + std::size_t{4} * 1440;
        bright += image->rgba[left + 1] > 128 ? 1U : 0U;
        differing += image->rgba[left] != image->rgba[right] ? 1U : 0U;
      }
    }
    EXPECT_GT(bright, 1000U) << name;
    EXPECT_GT(differing, 10000U) << name;
  }
}

TEST_F(Demo, LeavesCurvesAndSessionsOfEveryMaterial) {
  for (const char* name : {"mica", "gold", "si3n4"}) {
    const auto session = servo::load_session(folder_->file(std::string("session-") + name + ".afms"));
    ASSERT_TRUE(session.has_value()) << session.error().message;
    ASSERT_NE(session->find(physics::EventKind::JumpToContact), nullptr);
    ASSERT_NE(session->find(physics::EventKind::JumpOffContact), nullptr);
    const std::string csv = core::read_file(folder_->file(std::string("curve-") + name + ".csv")).value();
    EXPECT_THAT(csv, HasSubstr("# hamaker_J: "));
    std::size_t head = 0;  // number of lines before the names of the columns: events, parameters and their sources
    for (std::size_t at = 0; csv[at] == '#'; at = csv.find('\n', at) + 1) ++head;
    EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), session->samples.size() + head + 1U);
    EXPECT_GT(head, session->events.size() + 16U) << "parameters and their sources";
    const auto curve = curves::parse_curve(csv, name);
    ASSERT_TRUE(curve) << curve.error().message;
    EXPECT_EQ(curve->metadata.curve_id, name);
  }
}

TEST_F(Demo, TheSnapInReallyMovesTheHand) {
  const servo::RecordedSession session = servo::load_session(folder_->file("session-mica.afms")).value();
  const scene::TipEvent* in = session.find(physics::EventKind::JumpToContact);
  // the pull of 0.34 N bends the hand's grip down: within 60 ms it is pulled with more than half of the final force
  double pull = 0;
  for (const scene::TipSample& s : session.samples) {
    if (s.time_ns > in->time_ns && s.time_ns < in->time_ns + 60'000'000) pull = std::min(pull, s.hand_force_n);
  }
  EXPECT_LT(pull, -0.1);
}

TEST_F(Demo, TheReportNeedsNoOtherFile) {
  const std::string html = core::read_file(folder_->file("report.html")).value();
  EXPECT_THAT(html, HasSubstr("data:image/png;base64,iVBOR"));
  EXPECT_THAT(html, HasSubstr("<svg"));
  EXPECT_THAT(html, HasSubstr("circular"));
  EXPECT_THAT(html, ::testing::Not(HasSubstr("src=\"fig")));
}

TEST_F(Demo, LeavesNothingElse) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(folder_->path())) files += entry.is_regular_file() ? 1U : 100U;
  const std::size_t pictures = 7, curves = 3, sessions = 3, report_and_summary = 2;
  EXPECT_EQ(files, pictures + curves + sessions + report_and_summary);
  EXPECT_TRUE(support::read_png(folder_->file("choosing.png")).has_value());
}

TEST_F(Demo, ASessionIsDrawnAgain) {
  const std::string picture = folder_->file("again.png");
  const auto again =
      support::run_program(support::touchafm() + " render --session " + folder_->file("session-gold.afms") +
                           " --at 1.5 --stereo left --eye-width 200 --out " + picture);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(support::read_png(picture)->width, 200U);
  fs::remove(picture);
}

// Another law, with parameters changed while the servo runs; the locale chooses the report's language.
TEST(DemoOfAnotherLaw, FeelsTheSameSampleWithOtherNumbers) {
  const support::ScratchFolder folder;
  const auto result =
      support::run_program("LC_ALL=de_DE.UTF-8 " + support::touchafm() + " demo --out " + folder.path() +
                           " --material mica --model dmt --vary spring-constant=0.2N/m:0.4N/m:2"
                           " --hand-speed 150mm/s --eye-width 160 --servo " +
                           support::servo_mode());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json all = nlohmann::json::parse(core::read_file(folder.file("summary.json")).value());
  ASSERT_EQ(all["materials"].size(), 1U);
  EXPECT_EQ(all["materials"]["mica"]["law"], "dmt");
  // a0 + F_ad/k on any lever that jumps
  EXPECT_NEAR(all["materials"]["mica"]["z_joc_m"].get<double>(), 0.3819e-9 + 1.399894e-9 / 0.1, 1e-12);
  ASSERT_EQ(all["variations"].size(), 2U);
  EXPECT_NEAR(all["variations"][0]["z_joc_m"].get<double>(), 0.3819e-9 + 1.399894e-9 / 0.2, 1e-12);
  EXPECT_NEAR(all["variations"][1]["z_joc_m"].get<double>(), 0.3819e-9 + 1.399894e-9 / 0.4, 1e-12);
  EXPECT_EQ(servo::load_session(folder.file("session-mica-vary-2.afms"))->parameters.contact.spring_constant.si, 0.4);
  EXPECT_TRUE(support::read_png(folder.file("vary-mica.png")).has_value());
  EXPECT_EQ(all["variations"][0]["title"], "Mica 200 mN/m") << "data and log stay English";
  EXPECT_THAT(result.err, HasSubstr("Mica"));
  const std::string html = core::read_file(folder.file("report.html")).value();
  EXPECT_THAT(html, HasSubstr("<html lang=\"de\">"));
  EXPECT_THAT(html, HasSubstr("<td>Glimmer 200 mN/m (dmt)</td>"));
}

TEST(DemoOfAnotherLaw, RefusesWhatCannotBeFeltBeforeAnythingMoves) {
  const support::ScratchFolder folder;
  const auto refused = [&](const std::string& options) {
    return support::run_program(support::touchafm() + " demo --out " + folder.file("none") + " " + options);
  };
  EXPECT_EQ(refused("--model paper-rule").exit_code, 2);
  EXPECT_EQ(refused("--model dynamic-paper").exit_code, 2);
  EXPECT_EQ(refused("--material unobtainium").exit_code, 2);
  EXPECT_EQ(refused("--vary spring-constant=0.1N/m:0.4N/m:1000").exit_code, 2);
  EXPECT_THAT(refused("--vary spring-constant=0.1:0.4:2").err, HasSubstr("--vary spring-constant=0.1:0.4:2: "));
  EXPECT_EQ(refused("--measured /nonexistent").exit_code, 3);
  const auto weak = refused("--vary work-of-adhesion=0.00001mJ/m2:2mJ/m2:2");
  EXPECT_NE(weak.exit_code, 0);
  EXPECT_THAT(weak.err, HasSubstr("mica"));
  EXPECT_FALSE(fs::exists(folder.file("none")));
}

}  // namespace demo_test
}  // namespace afm::app
