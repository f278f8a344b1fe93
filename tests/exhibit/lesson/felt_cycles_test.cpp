// SPDX-License-Identifier: Apache-2.0
// A lesson counts a cycle only if the force that its step sets was on the hand from snap-in to pull-off.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "exhibit/lesson/lesson_run.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/simulated_student.h"
#include "scene/samples/material_library.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace felt_cycles_test {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;
using Wants = LessonPrompt::Wants;
using physics::EventKind;

class FeltCycles : public ::testing::Test {
 protected:
  FeltCycles() {
    lesson_.id = "felt";
    lesson_.title.texts = {"Felt", "Gespürt"};
    lesson_.materials = {"mica", "si3n4"};
    lesson_.scale = scene::ScaleMode::Common;
    samples_ = lesson_samples(lesson_, scene::load_materials(support::source("assets/materials.toml")).value()).value();
  }

  LessonRun run(StepKind kind, std::optional<Condition> condition = std::nullopt,
                const Phrases& phrases = test::english()) {
    LessonStep step;
    step.id = "felt";
    step.kind = kind;
    step.words.texts = {"Do this.", "Tu das."};
    step.materials = {0, 1};
    if (kind == StepKind::Cycle || kind == StepKind::Threshold) step.materials = {0};
    step.trials = 2;
    step.each_condition = condition.has_value();
    lesson_.steps = {step};
    lesson_.conditions.clear();
    if (condition) lesson_.conditions = {*condition};
    rows_.clear();
    return LessonRun(
        lesson_, samples_, phrases, {.seed = 3},
        [this](const TrialRow& row) {
          rows_.push_back(row);
          return core::Result<void>{};
        },
        0.0);
  }
  // A snap-in, a second later something else, and the pull-off after one more.
  void cycle(LessonRun& run, HandForce at_snap_in, HandForce between, HandForce at_pull_off) {
    const auto material = static_cast<std::int32_t>(run.prompt(now_s_).material.value_or(0));
    scene::TipEvent event;
    event.material = material;
    event.force_before_n = -1e-9;
    run.force_is(at_snap_in, now_s_ += 1);
    event.kind = EventKind::JumpToContact;
    run.happened(event, now_s_ += 1);
    run.force_is(between, now_s_ += 1);
    run.force_is(at_pull_off, now_s_ += 1);
    event.kind = EventKind::JumpOffContact;
    run.happened(event, now_s_ += 1);
  }
  void felt(LessonRun& run) { cycle(run, HandForce::Full, HandForce::Full, HandForce::Full); }
  std::size_t counted() const {
    return static_cast<std::size_t>(
        std::count_if(rows_.begin(), rows_.end(), [](const TrialRow& row) { return row.force.value_or(false); }));
  }

  Lesson lesson_;
  std::vector<curves::SampleModel> samples_;
  std::vector<TrialRow> rows_;
  double now_s_ = 0;
};

constexpr std::array kUnfelt{HandForce::None, HandForce::Changing, HandForce::Reduced};

TEST_F(FeltCycles, CountOnlyWithTheFullForceFromSnapInToPullOff) {
  for (const HandForce less : kUnfelt) {
    for (int when = 0; when < 3; ++when) {
      auto run = this->run(StepKind::Cycle);
      const auto at = [&](int place) { return place == when ? less : HandForce::Full; };
      cycle(run, at(0), at(1), at(2));
      EXPECT_EQ(counted(), 0U) << when;
      ASSERT_EQ(rows_.size(), 1U) << "the attempt is kept";
      EXPECT_EQ(rows_[0].force, false);
      EXPECT_EQ(rows_[0].response, "");
      EXPECT_THAT(run.prompt(now_s_).progress, HasSubstr("trial 1 of 2"));
      felt(run);
      EXPECT_EQ(counted(), 1U);
      EXPECT_EQ(rows_.back().response, "1e-09");
      EXPECT_EQ(rows_.back().trial, 1);
      EXPECT_THAT(run.prompt(now_s_).progress, HasSubstr("trial 2 of 2"));
    }
  }
}

TEST_F(FeltCycles, NeedAForceThatWasReported) {
  auto run = this->run(StepKind::Cycle);
  scene::TipEvent event;
  event.material = 0;
  for (const EventKind kind : {EventKind::JumpToContact, EventKind::JumpOffContact}) {
    event.kind = kind;
    run.happened(event, now_s_ += 1);
  }
  EXPECT_EQ(counted(), 0U);
  EXPECT_THAT(run.prompt(now_s_).words, HasSubstr("does not count"));
}

TEST_F(FeltCycles, SayWhyTheyDoNotCountUntilOneDoes) {
  auto run = this->run(StepKind::Cycle);
  EXPECT_EQ(run.prompt(0).words, "Do this.");
  cycle(run, HandForce::Full, HandForce::None, HandForce::None);
  const LessonPrompt lost = run.prompt(now_s_);
  EXPECT_THAT(lost.words, StartsWith("That cycle does not count: the force was not on"));
  EXPECT_THAT(lost.words, ::testing::EndsWith(" Do this."));
  cycle(run, HandForce::Reduced, HandForce::Reduced, HandForce::Reduced);
  EXPECT_THAT(run.prompt(now_s_).words, HasSubstr("weaker"));
  felt(run);
  EXPECT_EQ(run.prompt(now_s_).words, "Do this.");
  cycle(run, HandForce::None, HandForce::None, HandForce::None);
  run.reset(now_s_);
  EXPECT_EQ(run.prompt(now_s_).words, "Do this.") << "the person begins again by themselves";
}

TEST_F(FeltCycles, SaySoInGermanToo) {
  const auto german = Phrases::load(support::source("assets/guidance/de.toml"));
  ASSERT_TRUE(german);
  auto run = this->run(StepKind::Cycle, std::nullopt, *german);
  cycle(run, HandForce::Full, HandForce::None, HandForce::None);
  EXPECT_THAT(run.prompt(now_s_).words, StartsWith("Dieser Zyklus zählt nicht"));
}

TEST_F(FeltCycles, SayItAtOnceAndNotOnlyAtThePullOff) {
  auto run = this->run(StepKind::Cycle);
  scene::TipEvent event;
  event.material = 0;
  event.kind = EventKind::JumpToContact;
  run.force_is(HandForce::Full, 1);
  run.happened(event, 2);
  run.force_is(HandForce::Changing, 3);
  EXPECT_THAT(run.prompt(3).words, HasSubstr("does not count"));
}

// Cycles that the hand did not feel are not asked about.
TEST_F(FeltCycles, OfAHiddenSampleAreRepeatedWithTheSameSampleAndNeverAsked) {
  auto run = this->run(StepKind::Identify);
  const auto shown = run.prompt(0).material;
  for (int i = 0; i < 5; ++i) {
    cycle(run, HandForce::None, HandForce::None, HandForce::None);
    EXPECT_EQ(run.prompt(now_s_).wants, Wants::Cycle);
    EXPECT_EQ(run.prompt(now_s_).material, shown);
  }
  ASSERT_EQ(rows_.size(), 5U);
  EXPECT_EQ(rows_[4].stimulus, rows_[0].stimulus);
  EXPECT_FALSE(rows_[4].correct);
  felt(run);
  ASSERT_EQ(run.prompt(now_s_).wants, Wants::Answer);
  run.answer(0, now_s_ += 1);
  EXPECT_EQ(rows_.back().force, true);
  EXPECT_TRUE(rows_.back().correct.has_value());
}

TEST_F(FeltCycles, OfAThresholdBeginWithTheFirstOfTheTwoAgain) {
  auto run = this->run(StepKind::Threshold);
  felt(run);
  EXPECT_THAT(run.prompt(now_s_).words, StartsWith("Second cycle."));
  const auto level_before = run.prompt(now_s_).right;
  cycle(run, HandForce::Full, HandForce::None, HandForce::None);
  const LessonPrompt again = run.prompt(now_s_);
  EXPECT_EQ(again.wants, Wants::Cycle);
  EXPECT_THAT(again.words, HasSubstr("First cycle."));
  EXPECT_EQ(again.right, level_before) << "the same pair";
  EXPECT_TRUE(rows_.back().level.has_value());
  felt(run);
  felt(run);
  EXPECT_EQ(run.prompt(now_s_).wants, Wants::Answer);
}

TEST_F(FeltCycles, OfAFreeStepNeedTheForceToo) {
  auto run = this->run(StepKind::Free);
  cycle(run, HandForce::None, HandForce::None, HandForce::None);
  cycle(run, HandForce::Full, HandForce::None, HandForce::None);
  EXPECT_FALSE(run.end());
  felt(run);
  felt(run);
  EXPECT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_EQ(rows_.back().force, true);
  auto left = this->run(StepKind::Free);
  left.go_on(1);
  ASSERT_EQ(rows_.size(), 1U);
  EXPECT_EQ(rows_[0].force, false) << "nothing was felt";
}

TEST_F(FeltCycles, OfThePictureAloneCountOnlyWithoutAForce) {
  for (const HandForce force : {HandForce::Changing, HandForce::Reduced, HandForce::Full}) {
    auto run = this->run(StepKind::Identify, Condition::Picture);
    cycle(run, force, force, force);
    EXPECT_EQ(run.prompt(now_s_).wants, Wants::Cycle);
    EXPECT_THAT(run.prompt(now_s_).words, HasSubstr("only for the eyes"));
    EXPECT_EQ(rows_.at(0).force, true);
    cycle(run, HandForce::None, HandForce::None, HandForce::None);
    ASSERT_EQ(run.prompt(now_s_).wants, Wants::Answer);
    run.answer(0, now_s_ += 1);
    EXPECT_EQ(rows_.back().force, false);
  }
  for (const Condition condition : {Condition::Haptics, Condition::Both, Condition::Sound}) {
    auto run = this->run(StepKind::Identify, condition);
    cycle(run, HandForce::None, HandForce::None, HandForce::None);
    EXPECT_EQ(run.prompt(now_s_).wants, Wants::Cycle);
  }
}

TEST_F(FeltCycles, BeginAnewAfterAReset) {
  auto run = this->run(StepKind::Cycle);
  scene::TipEvent event;
  event.material = 0;
  event.kind = EventKind::JumpToContact;
  run.force_is(HandForce::Full, 0);
  run.happened(event, 1);
  run.reset(2);
  event.kind = EventKind::JumpOffContact;
  run.happened(event, 3);
  EXPECT_TRUE(rows_.empty());
}

TEST_F(FeltCycles, AfterTheEndAreNothing) {
  auto run = this->run(StepKind::Cycle);
  scene::TipEvent event;
  event.material = 0;
  event.kind = EventKind::JumpToContact;
  run.force_is(HandForce::Full, 1);
  run.happened(event, 2);
  run.stop();
  run.force_is(HandForce::None, 3);
  EXPECT_TRUE(rows_.empty());
}

TEST_F(FeltCycles, OfASimulatedStudentAreAllFelt) {
  for (const StepKind kind : {StepKind::Free, StepKind::Cycle, StepKind::Identify, StepKind::Threshold}) {
    for (const auto condition : {std::optional<Condition>(), std::optional(Condition::Picture)}) {
      auto run = this->run(kind, condition);
      SimulatedStudent student({.seed = 4, .abilities = {}}, lesson_, samples_);
      const auto taken = student.take(run);
      ASSERT_TRUE(taken) << taken.error().message;
      for (const TrialRow& row : rows_) EXPECT_EQ(row.force, !condition.has_value());
      EXPECT_EQ(rows_.size(), kind == StepKind::Free ? 1U : 2U);
    }
  }
}

TEST(ForceOnTheHand, IsFullOnlyWhileTheServoRunsWithItsWholeStrength) {
  using scene::ServoState;
  EXPECT_EQ(hand_force(ServoState::Running, 1.0), HandForce::Full);
  EXPECT_EQ(hand_force(ServoState::Running, kFullShare), HandForce::Full);
  EXPECT_EQ(hand_force(ServoState::Running, 0.9), HandForce::Reduced);
  EXPECT_EQ(hand_force(ServoState::Arming, 1.0), HandForce::Changing);
  EXPECT_EQ(hand_force(ServoState::Fading, 1.0), HandForce::Changing);
  EXPECT_EQ(hand_force(ServoState::Disarmed, 1.0), HandForce::None);
  EXPECT_EQ(hand_force(ServoState::Fault, 1.0), HandForce::None);
}

}  // namespace felt_cycles_test
}  // namespace afm::exhibit
