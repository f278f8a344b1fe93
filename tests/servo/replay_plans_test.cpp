// SPDX-License-Identifier: Apache-2.0
// Invariant: a replay guides the hand along the plans of its session, bit for bit
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/whole_file.h"
#include "servo/recorded_servo.h"
#include "servo/replay.h"
#include "servo/session_file.h"
#include "support/particles/gold_particles.h"
#include "support/scratch_folder.h"

namespace afm::servo {
namespace replay_plans_test {

using physics::EventKind;
using scene::ScaleMode;
using testing::HasSubstr;

// A push with a groove that is switched on, replanned and off in the middle of it, beside the line.
void push_guided(Recording& recording) {
  const scene::PlannedPush guided{.from_m = {-80e-9, 0.0}, .to_m = {70e-9, 5e-9}, .particle = 0, .guided = 1};
  scene::PlannedPush elsewhere = guided, alone = guided;
  elsewhere.to_m = {60e-9, -40e-9};
  alone.guided = 0;
  recording.choose(test::kMica, ScaleMode::Particles);
  recording.run(200);
  recording.plan(alone);
  recording.arm();
  recording.go({-0.028, 0.002}, 0.03, 0.3);
  recording.run(501);
  recording.plan(guided);
  recording.run(333);
  recording.go({-0.028, 0.002}, 0.001, 0.3);
  recording.run(500);
  recording.go({0.020, 0.002}, 0.001, 2.0);
  recording.run(701);
  recording.plan(elsewhere);
  recording.run(1300);
  recording.plan({});
  recording.go({0.020, 0.002}, 0.05, 0.3);
  recording.run(600);
}

TEST(ReplayOfPlans, GivesEveryBitAgainOfAHandThatAGrooveGuides) {
  Recording recording(test::model_with_particles());
  push_guided(recording);
  ASSERT_EQ(recording.sessions.size(), 1U);
  RecordedSession& session = recording.sessions.front();
  const auto guided = [](const scene::TipSample& sample) {
    return std::hypot(sample.guide_n[0], sample.guide_n[1]) > 0.1;
  };
  EXPECT_GT(std::count_if(session.samples.begin(), session.samples.end(), guided), 500);
  const auto touches = [](const scene::TipEvent& event) { return event.kind == EventKind::ParticleTouched; };
  EXPECT_TRUE(std::any_of(session.events.begin(), session.events.end(), touches));
  expect_same(session);

  session.has_plans = true;
  session.hand_m_per_m = recording.state().active.scale.hand_m_per_m;
  session.hand_n_per_n = recording.state().active.scale.hand_n_per_n;
  const support::ScratchFolder folder;
  const std::string path = folder.file("guided.afms");
  ASSERT_TRUE(save_session(session, path));
  EXPECT_EQ(core::read_beginning(path, 5).value(), "AFMS\x0b") << "a program without grooves refuses the version";
  const auto loaded = load_session(path);
  ASSERT_TRUE(loaded) << loaded.error().message;
  EXPECT_TRUE(loaded->has_plans);
  EXPECT_EQ(loaded->samples[1500].plan, session.samples[1500].plan);
  expect_same(*loaded);
  const auto then = replay_particles(*loaded, session.samples[1500].time_ns);
  ASSERT_TRUE(then) << then.error().message;
  EXPECT_EQ(then->plan, session.samples[1500].plan);

  // another plan gives another force
  RecordedSession other = *loaded;
  for (scene::TipSample& sample : other.samples) {
    if (sample.plan.guided != 0) sample.plan.to_m[1] += 1e-9;
  }
  const auto differs = replay(other);
  ASSERT_TRUE(differs) << differs.error().message;
  ASSERT_TRUE(differs->first);
  EXPECT_THAT(differs->first->quantity, HasSubstr("guide_"));
}

TEST(ReplayOfPlans, RefusesAFileWithAPlanThatCannotBe) {
  Recording recording(test::model_with_particles());
  recording.choose(test::kMica, ScaleMode::Particles);
  recording.run(50);
  RecordedSession session = recording.sessions.front();
  session.has_plans = true;
  session.hand_m_per_m = session.hand_n_per_n = 1.0;
  const support::ScratchFolder folder;
  const std::string path = folder.file("planned.afms");
  const scene::PlannedPush whole{.from_m = {0.0, 0.0}, .to_m = {1e-7, 0.0}, .particle = 2};
  session.samples[7].plan = whole;
  ASSERT_TRUE(save_session(session, path));
  EXPECT_TRUE(load_session(path)) << load_session(path).error().message;
  scene::PlannedPush of_none = whole, of_no_length = whole;
  of_none.particle = 3;
  of_no_length.to_m = whole.from_m;
  for (const scene::PlannedPush& bad : {of_none, of_no_length}) {
    session.samples[7].plan = bad;
    ASSERT_TRUE(save_session(session, path));
    const auto refused = load_session(path);
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr("the plan of a push is impossible"));
  }
}

}  // namespace replay_plans_test
}  // namespace afm::servo
