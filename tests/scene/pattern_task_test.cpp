// SPDX-License-Identifier: Apache-2.0
// Invariant: a simulated person with delay and tremor solves a task
#include "scene/samples/pattern_task.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "scene/samples/particle_files.h"
#include "support/places.h"

namespace afm::scene {
namespace pattern_task_test {

using physics::EventKind;
using Place = physics::ParticlePlace;

constexpr double kHighM = 100e-9, kLowM = 5e-9;

// Ticks of 1 ms, made by hand.
class PatternTaskTest : public ::testing::Test {
 protected:
  void tick(double z_m, double x_m = 0.0, double lateral_n = 0.0) {
    now_ns_ += 1'000'000;
    task_.add({.time_ns = now_ns_,
               .base_m = {x_m, 0.0, z_m},
               .lateral_n = {lateral_n, 0.0},
               .places = places_,
               .guided = guided_,
               .swept = swept_,
               .truth = truth_});
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
    for (Place& place : places) place.position.x = place.position.x + physics::Length(off_m);
    task_.judge(places);
  }
  const TaskScore& score() const { return task_.score(); }

  ParticleSet set_ = load_particle_set(particle_file("gold-row", support::source("assets")).value()).value();
  PatternTask task_{set_, pattern_of(set_)};
  std::int64_t now_ns_ = 7'000'000'000;
  std::uint64_t places_ = 99;
  bool guided_ = false;
  bool truth_ = false;
  bool swept_ = false;
};

TEST_F(PatternTaskTest, CountsAllThatAScanSweepsAsOnePush) {
  swept_ = guided_ = true;
  for (int i = 0; i < 20; ++i) {
    if (i % 3 == 0) ++places_;
    tick(kHighM);
  }
  swept_ = false;
  wait(10);
  EXPECT_EQ(score().strokes, 1U);
  EXPECT_EQ(score().guided, 0U) << "a groove guides the hand alone";
  guided_ = false;
  order(EventKind::PushTakenBack);
  EXPECT_EQ(score().undos, 1U);
  stroke();
  EXPECT_EQ(score().strokes, 2U);
}

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

TEST_F(PatternTaskTest, GoesOnWhenAPushFromBeforeItsEndIsTakenBack) {
  stroke();
  stroke();
  wait(600);
  judge(10e-9);
  const TaskScore done = score();
  ASSERT_EQ(done.state, TaskState::Done);
  stroke();
  order(EventKind::PushTakenBack);
  EXPECT_EQ(score(), done) << "the pattern is there again";
  order(EventKind::PushTakenBack);
  EXPECT_EQ(score().state, TaskState::Running);
  EXPECT_EQ(score().strokes, 2U);
  EXPECT_EQ(score().undos, 1U);
  EXPECT_EQ(score().rms_m, 0.0);
  EXPECT_GT(score().time_s, done.time_s + 0.6) << "the clock goes on";
  wait(600);
  ASSERT_EQ(task_.unjudged(), places_);
  judge(26e-9);
  EXPECT_EQ(score().state, TaskState::Running);
  stroke();
  wait(600);
  judge(20e-9);
  EXPECT_EQ(score().state, TaskState::Done);
  EXPECT_EQ(score().strokes, 3U);
  EXPECT_EQ(score().undos, 1U);
  EXPECT_NEAR(score().rms_m, 20e-9, 1e-15);
}

// A window looks once a frame, a replay at every tick.
TEST_F(PatternTaskTest, DoesNotJudgeASphereThatHangsOnTheTip) {
  stroke();
  for (int i = 0; i < 1000; ++i) {
    now_ns_ += 1'000'000;
    task_.add({.time_ns = now_ns_, .base_m = {0.0, 0.0, kHighM}, .lateral_n = {}, .places = places_, .carries = true});
    ASSERT_FALSE(task_.unjudged()) << i;
  }
  wait(501);
  EXPECT_TRUE(task_.unjudged()) << "it has been released";
}

TEST_F(PatternTaskTest, SeesARestAlsoAfterTheHandHasComeDownAgain) {
  const auto score_of = [&](int every) {
    PatternTask task(set_, pattern_of(set_));
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
    for (int i = 0; i < 30; ++i) tick(kLowM, -3e-10);  // contact without motion
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

// A groove is an aid, like a push taken back.
TEST_F(PatternTaskTest, CountsPushesInAGrooveOnceEach) {
  guided_ = true;
  tick(kLowM);
  tick(kLowM, 1e-9, -1e-10);
  tick(kHighM);
  EXPECT_EQ(score().guided, 0U) << "no particle has moved";
  stroke();
  EXPECT_EQ(score().guided, 1U);
  guided_ = false;
  stroke();
  EXPECT_EQ(score().guided, 1U);
  // switched on in the middle
  tick(kLowM);
  ++places_;
  tick(kLowM, 1e-9, -2e-10);
  guided_ = true;
  for (int i = 0; i < 5; ++i) tick(kLowM, 1e-9, -2e-10);
  EXPECT_EQ(score().guided, 2U);
  EXPECT_EQ(score().strokes, 3U);
}

// Another aid, which counts for the whole task as soon as it is used for one tick.
TEST_F(PatternTaskTest, NotesThatTheParticlesThemselvesWereShown) {
  truth_ = true;
  wait(100);
  EXPECT_EQ(score().truth, 0U) << "the task has not begun";
  truth_ = false;
  stroke();
  EXPECT_EQ(score().truth, 0U);
  truth_ = true;
  tick(kHighM);
  truth_ = false;
  wait(100);
  EXPECT_EQ(score().truth, 1U);
  order(EventKind::ParticlesPutBack);
  stroke();
  EXPECT_EQ(score().truth, 0U) << "another task";
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
  // the particles are back at the places after two strokes, and the clock of those continues
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
            "not done after 1.0 s; pushes: 1, slipped past: 0, taken back: 0, in a groove: 0, particles shown: no; "
            "1.9 aJ of work, at most 200 pN sideways");
}

// N71: a rod is laid across its pads, wherever its ends are.
TEST(RodAcrossPads, IsJudgedAlongTheRodAndNotAtItsEnds) {
  const ParticleSet set =
      load_particle_set(particle_file("tube-and-electrodes", support::source("assets")).value()).value();
  ASSERT_EQ(set.pads.size(), 2U);
  const auto laid = [&](double x_m, double y_m, double degrees) {
    const Place rod{{physics::Length(x_m), set.targets[0].position.y + physics::Length(y_m)},
                    physics::half_turn(degrees * std::numbers::pi / 180.0)};
    return pattern_state(set, pattern_of(set), std::vector{rod}).value();
  };
  const PatternState across = laid(0.0, 40e-9, 7.0);
  EXPECT_NEAR(across.match.rms.si, 72.98578067e-9, 1e-15);
  EXPECT_TRUE(across.done());
  EXPECT_NEAR(laid(0.0, 40e-9, 187.0).match.rms.si, across.match.rms.si, 1e-15) << "either way round";
  EXPECT_EQ(laid(0.0, 0.0, 25.0).touched, 0U) << "beyond the pads at both ends";
  EXPECT_EQ(laid(120e-9, 0.0, 0.0).touched, 1U) << "too far to one side";
  EXPECT_FALSE(laid(120e-9, 0.0, 0.0).done());
  EXPECT_EQ(laid(0.0, 0.0, 90.0).touched, 0U);
  const Pad pad{.middle = {}, .half_size = {physics::Length(1e-7), physics::Length(1e-8)}};
  const auto crosses = [&](double x_m, double y_m, double degrees) {
    return touches(
        pad, {{physics::Length(x_m), physics::Length(y_m)}, physics::half_turn(degrees * std::numbers::pi / 180.0)},
        physics::Length(1e-6));
  };
  EXPECT_TRUE(crosses(0.0, 0.0, 45.0)) << "its ends are far outside";
  EXPECT_TRUE(crosses(0.0, 0.49e-6, 90.0));
  EXPECT_FALSE(crosses(0.0, 0.52e-6, 90.0));
  EXPECT_FALSE(crosses(0.0, 0.02e-6, 0.0));
}

}  // namespace pattern_task_test
}  // namespace afm::scene
