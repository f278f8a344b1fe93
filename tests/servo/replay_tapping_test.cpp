// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/fnv1a.h"
#include "core/whole_file.h"
#include "servo/recorded_servo.h"
#include "servo/session_file.h"
#include "support/paper_model.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_tapping_test {

// The sample of docs/tapping.md under a lever of 40 N/m at 300 kHz, Q = 400, A0 = 20 nm.
scene::SharedModel tapped_model() {
  auto model = test::paper_model();
  scene::SharedContact& mica = model.materials[test::kMica];
  mica.law = physics::Law::Dmt;
  mica.contact.tip_radius = physics::Length(20e-9);
  mica.contact.spring_constant = physics::Stiffness(40.0);
  mica.contact.hamaker = physics::Energy(64e-21);
  mica.contact.mean_surface_energy = physics::SurfaceEnergy(0.0312);
  mica.contact.reduced_modulus = physics::Pressure(1.5e9);
  mica.lever = {physics::Frequency(300e3), 400.0, physics::Temperature(295.0)};
  mica.free_amplitude_m = 20e-9;
  mica.drive_hz = 300e3;
  return model;
}

// Down through the jump and up again.
void tap_once(Recording& recording) {
  recording.choose(test::kMica);
  recording.arm();
  recording.aim(0.002, 2.0);
  recording.run(2400);
  recording.aim(0.065, 2.0);
  recording.run(2400);
}

TEST(Replay, GivesASwingAgain) {
  Recording recording(tapped_model());
  tap_once(recording);
  const support::ScratchFolder folder;
  const std::string path = folder.file("tapping.afms");
  ASSERT_TRUE(save_session(recording.sessions.front(), path));
  const auto bytes = core::read_file(path);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(bytes->at(4), 22);  // version
  const auto loaded = load_session(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->parameters.free_amplitude_m, 20e-9);

  // both jumps, and a push that grows up to the first and is never a pull
  ASSERT_NE(loaded->find(physics::EventKind::JumpToRepulsion), nullptr);
  ASSERT_NE(loaded->find(physics::EventKind::JumpToAttraction), nullptr);
  EXPECT_NEAR(loaded->find(physics::EventKind::JumpToRepulsion)->z_m, 16.5e-9, 0.4e-9);
  EXPECT_NEAR(loaded->find(physics::EventKind::JumpToAttraction)->z_m, 18.83e-9, 0.4e-9);
  EXPECT_EQ(loaded->find(physics::EventKind::JumpToContact), nullptr);
  double strongest_n = 0.0, weakest_n = HUGE_VAL, smallest_m = HUGE_VAL;
  for (const scene::TipSample& sample : loaded->samples) {
    if (sample.servo_state != scene::ServoState::Running) continue;
    strongest_n = std::max(strongest_n, sample.hand_force_n);
    weakest_n = std::min(weakest_n, sample.hand_force_n);
    smallest_m = std::min(smallest_m, sample.swing.amplitude_m);
  }
  EXPECT_GT(strongest_n, 0.3);
  EXPECT_LT(strongest_n, 2.0);
  EXPECT_GT(weakest_n, -0.05);
  EXPECT_LT(smallest_m, 6e-9);
  expect_same(*loaded);
}

// The mean force in place of the push: pulled on the way down, pushed below the jump.
TEST(Replay, GivesTheFeltMeanForceOfASwingAgain) {
  auto model = tapped_model();
  model.materials[test::kMica].felt_mean_force = 1;
  Recording recording(model);
  tap_once(recording);
  const support::ScratchFolder folder;
  const std::string path = folder.file("tapping.afms");
  ASSERT_TRUE(save_session(recording.sessions.front(), path));
  const auto loaded = load_session(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_EQ(loaded->parameters.felt_mean_force, 1U);
  ASSERT_NE(loaded->find(physics::EventKind::JumpToRepulsion), nullptr);
  double pull_n = 0.0, push_n = 0.0;
  for (const scene::TipSample& sample : loaded->samples) {
    if (sample.servo_state != scene::ServoState::Running) continue;
    pull_n = std::min(pull_n, sample.hand_force_n);
    push_n = std::max(push_n, sample.hand_force_n);
  }
  EXPECT_LT(pull_n, -0.1);
  EXPECT_GT(push_n, 0.1);
  expect_same(*loaded);
}

TEST(Replay, RefusesASwingThatNoHandCanFeel) {
  auto model = tapped_model();
  model.materials[test::kMica].lever.quality_factor = 2500.0;
  auto segment = scene::SharedSegment::create(model, 0);
  ASSERT_TRUE(segment);
  FaultyDevice device;
  const auto loop = haptics::ServoLoop::create(*segment, device, {.rate_hz = 1000.0});
  ASSERT_FALSE(loop);
  EXPECT_NE(loop.error().message.find("relaxation"), std::string::npos) << loop.error().message;
}

// The forces and swings of the hand, in units far below what is felt and far above the last bit of a cosine.
std::uint64_t digest_of(const RecordedSession& session) {
  core::Fnv1a digest;
  const auto add = [&digest](double value, double unit) {
    const auto units = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::nearbyint(value / unit)));
    for (int shift = 0; shift < 64; shift += 8) digest.add(static_cast<unsigned char>(units >> shift));
  };
  for (const scene::TipSample& sample : session.samples) {
    add(sample.hand_force_n, 0x1p-40);
    add(sample.swing.amplitude_m, 0x1p-70);
    add(sample.swing.phase_rad, 0x1p-40);
  }
  return digest.value();
}

RecordedSession tapped_beside_resonance(scene::OlderTapping older) {
  auto model = tapped_model();
  model.materials[test::kMica].drive_hz = 303e3;
  model.materials[test::kMica].older_tapping = older;
  Recording recording(model);
  recording.choose(test::kMica);
  recording.arm();
  recording.aim(0.002, 0.3);
  recording.run(400);
  recording.aim(0.065, 0.3);
  recording.run(400);
  return recording.sessions.front();
}

struct Version {
  scene::OlderTapping older;
  int number;
  bool harmonics, jump_off;  // words in the header
};

// Version 10 does not name the harmonics, which were those at the resonance, and neither it nor 21 the Z of a jump off.
TEST(Replay, GivesASwingBesideTheResonanceAgainAsItsVersionHadIt) {
  using scene::OlderTapping;
  const support::ScratchFolder folder;
  const std::string path = folder.file("tapping.afms");
  for (const Version& version :
       {Version{OlderTapping::Version10, 10, false, false}, Version{OlderTapping::Version21, 21, true, false},
        Version{OlderTapping::None, 22, true, true}}) {
    SCOPED_TRACE(version.number);
    ASSERT_TRUE(save_session(tapped_beside_resonance(version.older), path));
    const auto bytes = core::read_file(path);
    ASSERT_TRUE(bytes);
    EXPECT_EQ(bytes->at(4), version.number);
    EXPECT_EQ(bytes->find("\"harmonics\"") != std::string::npos, version.harmonics);
    EXPECT_EQ(bytes->find("\"jump_off\"") != std::string::npos, version.jump_off);
    const auto loaded = load_session(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->parameters.older_tapping, version.older);
    // computed by the program that had no other harmonics
    constexpr std::uint64_t kBeforeVersion21 = 14042984769111705009U;
    EXPECT_EQ(digest_of(*loaded) == kBeforeVersion21, version.older == OlderTapping::Version10);
    expect_same(*loaded);
  }
}

}  // namespace replay_tapping_test
}  // namespace afm::servo
