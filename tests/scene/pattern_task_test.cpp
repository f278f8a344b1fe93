// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/pattern_task.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/samples/particle_files.h"
#include "support/places.h"

namespace afm::scene {
namespace pattern_task_test {

using physics::EventKind;
using Place = physics::Sideways<physics::Length>;

constexpr double kHighM = 100e-9, kLowM = 5e-9;

// Ticks of 1 ms, made by hand.
class PatternTaskTest : public ::testing::Test {
 protected:
  void tick(double z_m, double x_m = 0.0, double lateral_n = 0.0) {
    now_ns_ += 1'000'000;
    task_.add({.time_ns = now_ns_, .base_m = {x_m, 0.0, z_m}, .lateral_n = {lateral_n, 0.0}, .places = places_});
  }
  void wait(int ticks, double z_m = kHighM) {
    for (int i = 0; i < ticks; ++i) tick(z_m);
  }
  void stroke() {
    tick(kLowM, 0.0, 0.0);
    for (int i = 0; i < 10; ++i) {
      ++places_;
      tick(kLowM, 1e-9 * (i + 1), -2e-10);
    }
    tick(kHighM, 10e-9);
  }
  // The servo has carried out an order.
  void order(EventKind kind) {
    task_.add(kind);
    ++places_;
    tick(kHighM);
  }
  void judge(double off_m) {
    std::vector<Place> places = set_.targets;
    for (Place& place : places) place.x = place.x + physics::Length(off_m);
    task_.judge(places);
  }
  const TaskScore& score() const { return task_.score(); }

  ParticleSet set_ = load_particle_set(particle_file("gold-row", support::source("assets")).value()).value();
  PatternTask task_{set_, set_.targets};
  std::int64_t now_ns_ = 7'000'000'000;
  std::uint64_t places_ = 99;
};

TEST_F(PatternTaskTest, BeginsWithTheFirstPush) {
  wait(3000);
  EXPECT_EQ(score(), TaskScore{});
  EXPECT_FALSE(task_.unjudged()) << "a pattern that is done from the start is no task";
  tick(kLowM);
  tick(kLowM, 1e-9, -1e-10);
  EXPECT_EQ(score().state, TaskState::NotBegun) << "touched, not moved";
  tick(kHighM);
  stroke();
  EXPECT_EQ(score().state, TaskState::Running);
  EXPECT_EQ(score().strokes, 1U);
  EXPECT_NEAR(score().time_s, 0.010, 1e-9);
  // 0.2 nN over 10 nm, half of it in the first nanometre
  EXPECT_NEAR(score().work_j, 2e-10 * 9.5e-9, 1e-24);
  EXPECT_DOUBLE_EQ(score().largest_lateral_n, 2e-10);
}

TEST_F(PatternTaskTest, EndsOnceTheHandHasBeenLiftedAndCountsUpToTheLift) {
  stroke();
  wait(300);
  EXPECT_FALSE(task_.unjudged()) << "not yet";
  stroke();
  wait(600);
  ASSERT_EQ(task_.unjudged(), places_);
  judge(26e-9);
  EXPECT_EQ(score().state, TaskState::Running);
  EXPECT_FALSE(task_.unjudged()) << "judged once";
  stroke();
  wait(600);
  ASSERT_EQ(task_.unjudged(), places_);
  judge(24e-9);
  EXPECT_EQ(score().state, TaskState::Done);
  EXPECT_NEAR(score().rms_m, 24e-9, 1e-15);
  EXPECT_NEAR(score().time_s, 0.3 + 0.6 + 3 * 0.012 - 0.002, 1e-9);
  EXPECT_EQ(score().strokes, 3U);
  const TaskScore done = score();
  stroke();
  task_.add(EventKind::ParticleLost);
  order(EventKind::PushTakenBack);
  wait(600);
  EXPECT_EQ(score(), done) << "nothing changes it";
  EXPECT_FALSE(task_.unjudged());
}

// A window looks once a frame, a replay at every tick.
TEST_F(PatternTaskTest, SeesARestAlsoAfterTheHandHasComeDownAgain) {
  const auto score_of = [&](int every) {
    PatternTask task(set_, set_.targets);
    std::int64_t ticks = 0;
    std::uint64_t places = 99;
    const auto tick = [&](double z_m, double lateral_n) {
      task.add({.time_ns = 1'000'000 * ++ticks,
                .base_m = {1e-9 * static_cast<double>(ticks), 0.0, z_m},
                .lateral_n = {lateral_n, 0.0},
                .places = places});
      if (ticks % every == 0 && task.unjudged() == places) task.judge(set_.targets);
    };
    tick(kLowM, 0.0);
    ++places;
    tick(kLowM, -2e-10);
    for (int i = 0; i < 501; ++i) tick(kHighM, 0.0);
    for (int i = 0; i < 30; ++i) tick(kLowM, -3e-10);  // touched, not moved
    return task.score();
  };
  const TaskScore score = score_of(1);
  EXPECT_EQ(score.state, TaskState::Done);
  EXPECT_NEAR(score.time_s, 0.001, 1e-9);
  EXPECT_DOUBLE_EQ(score.largest_lateral_n, 2e-10);
  EXPECT_EQ(score_of(17), score);
}

TEST_F(PatternTaskTest, CountsLossesAndPushesTakenBackButNoOtherEvents) {
  task_.add(EventKind::ParticleLost);
  stroke();
  task_.add(EventKind::ParticleLost);
  task_.add(EventKind::ParticleGave);
  task_.add(EventKind::JumpToContact);
  tick(kHighM);
  order(EventKind::PushTakenBack);
  EXPECT_EQ(score().losses, 1U) << "while the task runs";
  EXPECT_EQ(score().undos, 1U);
  EXPECT_EQ(score().strokes, 1U) << "what is taken back was made";
  EXPECT_EQ(score().state, TaskState::Running);
}

TEST_F(PatternTaskTest, BeginsAnewWhenAllIsPutBackUnlessThatIsTakenBack) {
  stroke();
  wait(100);
  stroke();
  order(EventKind::ParticlesPutBack);
  EXPECT_EQ(score(), TaskScore{});
  wait(1000);
  stroke();
  EXPECT_EQ(score().strokes, 1U);
  order(EventKind::PushTakenBack);
  EXPECT_EQ(score().undos, 1U);
  EXPECT_EQ(score().strokes, 1U);
  // the particles are again where two strokes had pushed them, and the clock of those goes on
  order(EventKind::PushTakenBack);
  tick(kHighM);
  EXPECT_EQ(score().strokes, 2U);
  EXPECT_EQ(score().undos, 1U);
  EXPECT_GT(score().time_s, 1.1);
}

TEST_F(PatternTaskTest, IsOneLineOfText) {
  EXPECT_EQ(text_of(score()), "not begun");
  stroke();
  wait(990);
  EXPECT_EQ(text_of(score()),
            "not done after 1.0 s; pushes: 1, slipped past: 0, taken back: 0; 1.9 aJ of work, at most "
            "200 pN sideways");
}

}  // namespace pattern_task_test
}  // namespace afm::scene
