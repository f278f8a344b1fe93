// SPDX-License-Identifier: Apache-2.0
// A simulated person pushes particles to their pattern through the servo's own code, in simulated time.
// Invariant: the score of a task is the same live, at any frame rate, and in a replay
#include "exhibit/state/particle_task.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "exhibit/state/particles_now.h"
#include "physics/manipulation/particle_friction.h"
#include "scene/samples/pattern_state.h"
#include "servo/live_picture.h"
#include "simulated_person.h"
#include "support/particles/particle_sets.h"

namespace afm::exhibit {
namespace particle_task_test {

// The score as a live window keeps it, which sees the particles once a frame.
scene::TaskScore live_score(const scene::ParticleSet& set, const servo::RecordedSession& session, std::size_t frame) {
  ParticleTask task(set);
  std::size_t tick = 0;
  const auto replayed = servo::replay(session, {}, [&](const servo::ReplayedTick& now) {
    for (const scene::TipEvent& event : now.events) task.add(event);
    task.add(now.sample, now.picture == nullptr);
    if (++tick % frame == 0) task.look(now.pages, now.picture);
  });
  EXPECT_TRUE(replayed && replayed->identical());
  return task.score();
}

TEST(ParticleTask, IsSolvedByAPersonWithDelayAndTremorAndScoredAlikeLiveAndInAReplay) {
  const scene::ParticleSet set = test::particle_set("gold-row");
  Person person(set, 11);
  person.solve(300.0);
  ASSERT_EQ(person.recording().sessions.size(), 1U);
  const servo::RecordedSession& session = person.recording().sessions.front();
  ParticleTask task(set);
  const auto replayed = servo::replay(session, {}, [&](const servo::ReplayedTick& tick) { task.hear(tick); });
  ASSERT_TRUE(replayed) << replayed.error().message;
  EXPECT_TRUE(replayed->identical());
  const scene::TaskScore score = task.score();
  EXPECT_EQ(score.state, scene::TaskState::Done) << scene::text_of(score);
  EXPECT_LT(score.time_s, 300.0);
  EXPECT_LE(score.rms_m, scene::median_radius(set).si);
  EXPECT_GE(score.strokes, 4U);
  EXPECT_GT(score.work_j, 10e-18);
  EXPECT_EQ(score.undos, 0U);
  EXPECT_EQ(score.truth, 1U) << "without a picture the particles themselves are shown";
  EXPECT_EQ(live_score(set, session, 17), score) << "at 60 frames a second";
  EXPECT_EQ(live_score(set, session, 450), score) << "at two frames a second";
}

// The score of a replay, which is that of a live window at any frame rate.
scene::TaskScore replayed_score(const scene::ParticleSet& set, const servo::RecordedSession& session) {
  ParticleTask task(set);
  bool was_dark = false;
  const auto replayed = servo::replay(session, {}, [&](const servo::ReplayedTick& tick) {
    task.hear(tick);
    was_dark = was_dark || task.dark();
    if (set.blind && tick.sample.push.particle != scene::kNoParticle && task.score().state != scene::TaskState::Done) {
      EXPECT_TRUE(task.dark());
    }
  });
  EXPECT_TRUE(replayed && replayed->identical());
  EXPECT_EQ(was_dark, set.blind.has_value());
  EXPECT_FALSE(task.score().state == scene::TaskState::Done && task.dark()) << "the picture is back";
  EXPECT_EQ(live_score(set, session, 17), task.score()) << "at 60 frames a second";
  EXPECT_EQ(live_score(set, session, 450), task.score()) << "at two frames a second";
  return task.score();
}

TEST(BlindTask, ComparesTheForceThatAHandHoldsWithTheThresholdThatItFelt) {
  const scene::ParticleSet set = test::particle_set("threshold-by-feel");
  Person person(set, 5);
  person.push_by_feel(0, {1.0, 0.0}, 0.004);
  person.press(1, 0.5, 4.0);
  const scene::TaskScore score = replayed_score(set, person.recording().sessions.front());
  ASSERT_EQ(score.state, scene::TaskState::Done) << scene::text_of(score);
  const physics::ParticleSpecies& gold = set.setup.species.front();
  EXPECT_NEAR(score.threshold_n / physics::sliding_threshold(gold, gold.law, physics::Force(0.0)).si, 1.0, 0.02)
      << "that of the file, and a little more under the tip that presses it down";
  EXPECT_NEAR(score.answer_n, person.held_n(), 0.1 * score.threshold_n) << "within the tremor of the hand";
  EXPECT_EQ(score.rms_m, 0.0);
  EXPECT_EQ(score.truth, 0U) << "nobody saw the particles";
  EXPECT_EQ(score.strokes, 1U);
}

TEST(BlindTask, IgnoresAPressBeforeTheThresholdWasFeltAndOneThatIsShort) {
  const scene::ParticleSet set = test::particle_set("threshold-by-feel");
  Person person(set, 5);
  person.press(1, 0.5, 4.0);
  person.push_by_feel(0, {1.0, 0.0}, 0.004);
  person.press(1, 0.1, 0.2);
  const scene::TaskScore score = replayed_score(set, person.recording().sessions.front());
  EXPECT_EQ(score.state, scene::TaskState::Running) << scene::text_of(score);
  EXPECT_GT(score.threshold_n, 0.0);
  EXPECT_EQ(score.answer_n, 0.0);
}

TEST(BlindTask, MeasuresTheDistanceFromTheLineOfAPushThatIsFarEnough) {
  const scene::ParticleSet set = test::particle_set("blind-line");
  Person person(set, 7);
  person.push_along_line(0.5);
  EXPECT_EQ(replayed_score(set, person.recording().sessions.front()).state, scene::TaskState::Running) << "half way";
  person.push_along_line(1.0);
  const scene::TaskScore score = replayed_score(set, person.recording().sessions.front());
  ASSERT_EQ(score.state, scene::TaskState::Done) << scene::text_of(score);
  const auto places = places_of({.set = &set, .pages = person.recording().pages()});
  EXPECT_NEAR(score.rms_m, std::abs((*places)[0].position.y.si), 1e-15) << "the line is along x";
  EXPECT_LT(score.rms_m, scene::median_radius(set).si);
  EXPECT_EQ(score.truth, 0U);
  EXPECT_EQ(score.answer_n, 0.0);
}

TEST(ParticleTask, IsJudgedByMeasuredPlacesAlone) {
  const scene::ParticleSet set = test::particle_set("gold-row");
  Person person(set, 11, 1);
  person.solve(300.0);
  const auto score_now = [&] {
    ParticleTask task(set);
    const auto replayed = servo::replay(person.recording().sessions.front(), {},
                                        [&](const servo::ReplayedTick& tick) { task.hear(tick); });
    EXPECT_TRUE(replayed && replayed->identical());
    return task.score();
  };
  const scene::TaskScore pushed = score_now();
  EXPECT_EQ(pushed.state, scene::TaskState::Running) << "the pattern is done, but only computed";
  person.look();
  const scene::TaskScore looked = score_now();
  EXPECT_EQ(looked.state, scene::TaskState::Done) << scene::text_of(looked);
  EXPECT_LT(looked.time_s, 300.0);
  EXPECT_LE(looked.rms_m, scene::median_radius(set).si);
  EXPECT_EQ(looked.strokes, pushed.strokes);
  EXPECT_EQ(looked.truth, 0U);
  EXPECT_LT(looked.time_s, pushed.time_s) << "up to the last lift, without the looks";
  EXPECT_EQ(live_score(set, person.recording().sessions.front(), 17), looked) << "at 60 frames a second";
}

// After ten minutes of drift the picture is off by more than a radius.
TEST(ParticleTaskOfAStudent, FailsByAnOldPictureAndIsSolvedByLooks) {
  const scene::ParticleSet set = test::particle_set("gold-row");
  for (const bool looks : {false, true}) {
    Person person(set, 11, 2);
    person.looks = looks;
    person.wait(600.0);
    person.solve(600.0);
    person.look();
    ParticleTask task(set);
    const auto replayed = servo::replay(person.recording().sessions.front(), {},
                                        [&](const servo::ReplayedTick& tick) { task.hear(tick); });
    ASSERT_TRUE(replayed && replayed->identical());
    EXPECT_EQ(task.score().state == scene::TaskState::Done, looks) << scene::text_of(task.score());
    if (looks) {
      EXPECT_LE(task.score().rms_m, scene::median_radius(set).si);
    }
  }
}

// Starts at the file's place, and at another one for which no file has a plan.
TEST(ParticleTaskOfAStudent, SteersARodAcrossItsPadsInThreeMinutes) {
  scene::ParticleSet other = test::particle_set("tube-and-electrodes");
  other.particles.front().angle_rad = -0.5;
  other.particles.front().position = {physics::Length(-30e-9), physics::Length(10e-9)};
  for (const scene::ParticleSet& set : {test::particle_set("tube-and-electrodes"), other}) {
    for (const unsigned seed : {3U, 4U, 5U}) {
      Person person(set, seed);
      person.lay_rod(180.0);
      const scene::TaskScore score = replayed_score(set, person.recording().sessions.front());
      ASSERT_EQ(score.state, scene::TaskState::Done) << scene::text_of(score);
      EXPECT_LT(score.time_s, 180.0);
      EXPECT_GE(score.strokes, 1U);
    }
  }
}

}  // namespace particle_task_test
}  // namespace afm::exhibit
