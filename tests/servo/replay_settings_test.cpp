// SPDX-License-Identifier: Apache-2.0
// Sessions with settings that a person has changed among the particles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "servo/recorded_servo.h"
#include "servo/session_file.h"
#include "support/particles/gold_particles.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_settings_test {

// Lifts, goes before the row, pushes along it up to a place, and lifts again.
void push(Recording& recording, double beside_m, double to_m = 0.020) {
  struct Goal {
    double x_m, height_m, seconds;
    int ticks;
  };
  recording.arm();
  for (const Goal& goal : std::array{Goal{-0.028, 0.03, 0.3, 500}, Goal{-0.028, 0.001, 0.3, 500},
                                     Goal{to_m, 0.001, 1.5, 1800}, Goal{to_m, 0.05, 0.3, 600}}) {
    recording.go({goal.x_m, beside_m}, goal.height_m, goal.seconds);
    recording.run(goal.ticks);
  }
}

// Another law, lever, tip and medium: a session each, stored with the numbers in use.
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

// Levels that are chosen while the servo runs: a session each, whose picture is drawn again as it was.
TEST(ReplayOfSettings, GivesEveryBitAgainAtAnotherLevel) {
  Recording recording(test::model_with_particles());
  std::vector<std::vector<scene::ParticlePage>> shown;
  std::vector<std::uint32_t> levels;
  const auto feel = [&](const scene::PushSettings& settings, double to_m) {
    recording.choose(test::kMica, scene::ScaleMode::Particles, settings);
    push(recording, 0.0, to_m);
    const LivePicture* picture = recording.picture.get();
    levels.push_back(picture != nullptr ? picture->now().level : 0);
    const auto pages = picture != nullptr ? picture->shown() : std::span<const scene::ParticlePage>(recording.pages());
    shown.emplace_back(pages.begin(), pages.end());
  };
  feel({}, -0.005);
  feel({.level = 3}, 0.001);
  feel({.lever = 4, .level = 3}, 0.007);
  feel({.law = 2, .level = 2}, 0.013);
  feel({.level = 1}, 0.019);
  EXPECT_EQ(levels, (std::vector<std::uint32_t>{0, 2, 2, 1, 0}));
  EXPECT_NE(shown[2], shown[1]) << "something was pushed";
  ASSERT_EQ(recording.sessions.size(), levels.size());
  const support::ScratchFolder folder;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const RecordedSession& session = recording.sessions[i];
    EXPECT_EQ(session.particles->set.level.level, levels[i]);
    const RecordedSession loaded = saved_and_replayed(session, folder.file("level.afms"));
    const auto then = replay_particles(loaded, session.samples.back().time_ns);
    ASSERT_TRUE(then) << then.error().message;
    EXPECT_EQ(then->picture.has_value(), levels[i] > 0);
    EXPECT_EQ(then->pages, shown[i]) << "session " << i;
  }
}

}  // namespace replay_settings_test
}  // namespace afm::servo
