// SPDX-License-Identifier: Apache-2.0
// Sessions with settings that a person has changed among the particles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "servo/recorded_servo.h"
#include "servo/session_file.h"
#include "support/particles/gold_particles.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_settings_test {

// Lifts, goes before the row, pushes along it, and lifts again.
void push(Recording& recording, double beside_m) {
  struct Goal {
    double x_m, height_m, seconds;
    int ticks;
  };
  recording.arm();
  for (const Goal& goal : std::array{Goal{-0.028, 0.03, 0.3, 500}, Goal{-0.028, 0.001, 0.3, 500},
                                     Goal{0.020, 0.001, 1.5, 1800}, Goal{0.020, 0.05, 0.3, 600}}) {
    recording.go({goal.x_m, beside_m}, goal.height_m, goal.seconds);
    recording.run(goal.ticks);
  }
}

// Another law, lever, tip and medium: a session each, stored with the numbers that were felt.
TEST(ReplayOfSettings, GivesEveryBitAgain) {
  Recording recording(test::model_with_particles());
  const auto feel = [&](const scene::PushSettings& settings, double beside_m) {
    recording.choose(test::kMica, scene::ScaleMode::Particles, settings);
    push(recording, beside_m);
  };
  feel({}, 0.0);
  feel({.law = 2, .medium = 1}, 0.001);
  feel({.tool = scene::PushTool::Grip, .lever = 4, .tip = 3}, 0.002);
  ASSERT_EQ(recording.sessions.size(), 3U);
  const support::ScratchFolder folder;
  for (const RecordedSession& session : recording.sessions) {
    EXPECT_TRUE(std::any_of(session.events.begin(), session.events.end(), [](const scene::TipEvent& event) {
      return event.kind == physics::EventKind::ParticleTouched;
    }));
    expect_same(session);
    const std::string path = folder.file("settings.afms");
    ASSERT_TRUE(save_session(session, path));
    const auto loaded = load_session(path);
    ASSERT_TRUE(loaded) << loaded.error().message;
    EXPECT_EQ(loaded->particles->set, session.particles->set);
    expect_same(*loaded);
  }
  EXPECT_EQ(recording.sessions[1].particles->set.species[0].law, physics::ParticleLaw::Amontons);
  EXPECT_NEAR(recording.sessions[1].particles->set.species[0].work_of_adhesion_j_per_m2, 0.292, 1e-12);
  EXPECT_EQ(recording.sessions[2].particles->set.pusher.normal_spring_n_per_m, 40.0);
  EXPECT_EQ(recording.sessions[2].particles->set.pusher.tip_radius_m, 20e-9);
  EXPECT_TRUE(scene::has_hold(recording.sessions[2].particles->set));
}

}  // namespace replay_settings_test
}  // namespace afm::servo
