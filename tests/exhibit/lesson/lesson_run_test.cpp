// SPDX-License-Identifier: Apache-2.0
// Invariant: a lesson's criteria are decided by the servo's events
#include "exhibit/lesson/lesson_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "exhibit/lesson/data_set.h"
#include "exhibit/lesson/lesson_samples.h"
#include "exhibit/lesson/simulated_student.h"
#include "scene/samples/material_library.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace lesson_run_test {

using ::testing::HasSubstr;
using Wants = LessonPrompt::Wants;

LessonStep step_of(StepKind kind, std::vector<std::size_t> materials = {}) {
  LessonStep step;
  step.id = std::string(word_of(kind));
  step.kind = kind;
  step.words.texts = {"Do this.", "Tu das."};
  step.materials = std::move(materials);
  return step;
}

class LessonRunTest : public ::testing::Test {
 protected:
  LessonRunTest() {
    lesson_.id = "test";
    lesson_.title.texts = {"Test", "Test"};
    lesson_.materials = {"mica", "si3n4"};
    lesson_.scale = scene::ScaleMode::Common;
    samples_ = lesson_samples(lesson_, scene::load_materials(support::source("assets/materials.toml")).value()).value();
  }

  LessonRun run(const LessonRun::Setup& setup = {}) {
    return LessonRun(
        lesson_, samples_, test::english(), setup,
        [this](const TrialRow& row) {
          rows_.push_back(row);
          return core::Result<void>{};
        },
        0.0);
  }
  static scene::TipEvent event(physics::EventKind kind, std::int32_t material, double before_n = -1e-9) {
    scene::TipEvent event;
    event.kind = kind;
    event.material = material;
    event.force_before_n = before_n;
    return event;
  }
  static void feel(LessonRun& run, std::int32_t material, double now_s) {
    run.force_is(HandForce::Full, now_s - 1);
    run.happened(event(physics::EventKind::JumpToContact, material), now_s - 1);
    run.happened(event(physics::EventKind::JumpOffContact, material, -2e-9), now_s);
  }

  Lesson lesson_;
  std::vector<curves::SampleModel> samples_;
  std::vector<TrialRow> rows_;
};

TEST_F(LessonRunTest, GoesOnByItselfWhenTheServosEventsMeetTheCriterion) {
  lesson_.steps = {step_of(StepKind::Cycle, {0}), step_of(StepKind::Text)};
  auto run = this->run();
  EXPECT_EQ(run.prompt(0).wants, Wants::Cycle);
  EXPECT_EQ(run.prompt(0).material, 0U);
  run.go_on(1);
  run.happened(event(physics::EventKind::JumpOffContact, 0), 2);  // no cycle, since the tip never snapped in
  feel(run, 1, 3);                                                // cycle on another material
  run.happened(event(physics::EventKind::Slip, 0), 4);
  EXPECT_TRUE(rows_.empty());
  feel(run, 0, 5);
  ASSERT_EQ(rows_.size(), 1U);
  EXPECT_EQ(rows_[0].response, "2e-09");
  EXPECT_DOUBLE_EQ(rows_[0].duration_s, 5.0);
  EXPECT_EQ(run.prompt(6).wants, Wants::GoOn);
  EXPECT_THAT(run.prompt(6).progress, HasSubstr("Step 2 of 2"));
  run.go_on(8);
  EXPECT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_EQ(line_of(rows_[1]),
            "5.000\t3.000\ttext\ttext\tn/a\t0\t1\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\n");
}

TEST_F(LessonRunTest, ShowsAHintAfterItsTimeAndCountsItAnewAfterAReset) {
  lesson_.steps = {step_of(StepKind::Cycle, {0})};
  lesson_.steps[0].hint.texts = {"Slowly.", "Langsam."};
  lesson_.steps[0].hint_after_s = 10;
  auto run = this->run();
  EXPECT_EQ(run.prompt(9.9).hint, "");
  EXPECT_EQ(run.prompt(10).hint, "Slowly.");
  run.reset(12);
  EXPECT_EQ(run.prompt(13).hint, "");
  run.skip(14);
  EXPECT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_TRUE(rows_.empty()) << "what was skipped is no trial";
}

TEST_F(LessonRunTest, HidesTheSampleToIdentifyAndKeepsPracticeApart) {
  lesson_.steps = {step_of(StepKind::Identify, {0, 1})};
  lesson_.steps[0].practice = 2;
  lesson_.steps[0].trials = 8;
  auto run = this->run({.seed = 5});
  double now_s = 0;
  std::map<std::string, int> shown;
  while (!run.end()) {
    const LessonPrompt prompt = run.prompt(now_s);
    EXPECT_TRUE(prompt.hidden);
    if (prompt.wants == Wants::Cycle) {
      EXPECT_TRUE(prompt.answers.empty());
      feel(run, static_cast<std::int32_t>(*prompt.material), now_s += 4);
      continue;
    }
    ASSERT_EQ(prompt.answers, (std::vector<std::string>{"Mica", "Silicon nitride"}));
    run.answer(7, now_s);  // no effect, since there is no such answer
    run.answer(0, now_s += 1);
    const TrialRow& row = rows_.back();
    EXPECT_EQ(row.response, "mica");
    EXPECT_EQ(*row.correct, row.stimulus == "mica");
    EXPECT_DOUBLE_EQ(*row.rt_s, 1.0);
    if (!row.practice) ++shown[row.stimulus];
    if (row.practice && rows_.size() < 2) {
      EXPECT_THAT(run.prompt(now_s).words, *row.correct ? HasSubstr("Right.") : HasSubstr("Not quite: Silicon"));
    }
  }
  ASSERT_EQ(rows_.size(), 10U);
  EXPECT_TRUE(rows_[1].practice);
  EXPECT_EQ(rows_[1].trial, 2);
  EXPECT_FALSE(rows_[2].practice);
  EXPECT_EQ(rows_[2].trial, 1);
  EXPECT_EQ(shown["mica"], 4);
  EXPECT_EQ(shown["si3n4"], 4);
}

TEST_F(LessonRunTest, AThresholdGivesTwoVariantsAndMovesItsLevelByCountedAnswersAlone) {
  lesson_.steps = {step_of(StepKind::Threshold, {1})};
  LessonStep& step = lesson_.steps[0];
  step.practice = 1;
  step.trials = 3;
  step.threshold = {.start = 0.5, .least = 0.01, .most = 1.0, .step = 1.25};
  auto run = this->run({.seed = 1});
  double now_s = 0;
  while (!run.end()) {
    std::vector<double> energies;
    std::set<std::uint32_t> cycles;
    while (run.prompt(now_s).wants == Wants::Cycle) {
      const LessonPrompt prompt = run.prompt(now_s);
      ASSERT_TRUE(prompt.variant.has_value());
      energies.push_back(prompt.variant->contact.mean_surface_energy.si);
      cycles.insert(prompt.cycle);
      feel(run, 1, now_s += 4);
    }
    ASSERT_EQ(energies.size(), 2U);
    EXPECT_EQ(cycles.size(), 2U);
    const LessonPrompt prompt = run.prompt(now_s);
    EXPECT_EQ(prompt.right, energies[1] > energies[0] ? 1U : 0U);
    run.answer(prompt.right, now_s += 1);
    EXPECT_NEAR(std::max(energies[0], energies[1]) / std::min(energies[0], energies[1]), 1.0 + *rows_.back().level,
                1e-9);
  }
  ASSERT_EQ(rows_.size(), 4U);
  EXPECT_NEAR(*rows_[0].level, 0.5, 1e-9);
  EXPECT_NEAR(*rows_[1].level, 0.5, 1e-9);
  EXPECT_NEAR(*rows_[2].level, 0.5 / 1.25 / 1.25, 1e-9);
  EXPECT_EQ(rows_[1].stimulus, rows_[1].response);
}

TEST_F(LessonRunTest, RepeatsARunOfStepsUnderEachConditionInTheOrderOfTheRow) {
  lesson_.conditions = {Condition::Haptics, Condition::Picture, Condition::Both};
  lesson_.steps = {step_of(StepKind::Text), step_of(StepKind::Text), step_of(StepKind::Text), step_of(StepKind::Text)};
  for (std::size_t i = 0; i < 4; ++i) lesson_.steps[i].id = std::string(1, static_cast<char>('a' + i));
  lesson_.steps[1].each_condition = lesson_.steps[2].each_condition = true;
  std::set<std::string> orders;
  for (std::size_t order = 0; order < 7; ++order) {
    rows_.clear();
    auto run = this->run({.order = order});
    while (!run.end()) run.go_on(1);
    std::string told;
    for (const TrialRow& row : rows_)
      told += row.step + (row.condition ? std::string(word_of(*row.condition)) + " " : "");
    orders.insert(told);
    if (order == 0 || order == 6) {
      EXPECT_EQ(told, "abhaptics chaptics bpicture cpicture bboth cboth d") << order;
    }
  }
  EXPECT_EQ(orders.size(), 6U);
}

TEST_F(LessonRunTest, AsksForConsentFirstAndKeepsNothingWithoutIt) {
  lesson_.steps = {step_of(StepKind::Text)};
  auto refused = this->run({.ask_consent = true});
  EXPECT_FALSE(refused.consented());
  EXPECT_THAT(refused.prompt(0).words, HasSubstr("Do you take part?"));
  refused.go_on(1);  // no answer
  EXPECT_FALSE(refused.end());
  refused.answer(1, 2);
  EXPECT_EQ(refused.end(), LessonEnd::Withdrew);
  EXPECT_TRUE(rows_.empty());
  auto given = this->run({.ask_consent = true});
  given.answer(0, 5);
  EXPECT_TRUE(given.consented());
  given.go_on(7);
  ASSERT_EQ(rows_.size(), 1U);
  EXPECT_DOUBLE_EQ(rows_[0].onset_s, 0.0) << "the lesson begins with the consent";
  EXPECT_DOUBLE_EQ(rows_[0].duration_s, 2.0);
}

TEST_F(LessonRunTest, StopsByTheSsqRule) {
  lesson_.steps = {step_of(StepKind::Question), step_of(StepKind::Text)};
  lesson_.steps[0].questionnaire = Questionnaire::Ssq;
  for (const bool severe : {false, true}) {
    rows_.clear();
    auto run = this->run();
    for (std::size_t item = 0; item < 16; ++item) run.answer(severe && item == 6 ? 3 : 0, 1);
    EXPECT_EQ(rows_.size(), 16U);
    EXPECT_EQ(rows_[6].stimulus, "ssq-7");
    EXPECT_EQ(rows_[6].response, severe ? "3" : "0");
    EXPECT_EQ(run.end().has_value(), severe);
    if (severe) {
      EXPECT_EQ(run.end(), LessonEnd::Stopped);
      EXPECT_THAT(run.prompt(1).words, HasSubstr("The lesson ends here"));
    }
  }
}

TEST_F(LessonRunTest, OffersABreakAfterTwentyMinutes) {
  lesson_.steps = {step_of(StepKind::Text), step_of(StepKind::Text), step_of(StepKind::Text)};
  auto run = this->run();
  run.go_on(20 * 60 - 1);
  EXPECT_EQ(run.prompt(20 * 60).wants, Wants::GoOn);
  run.go_on(20 * 60);
  ASSERT_EQ(run.prompt(20 * 60).answers.size(), 2U) << "it can be extended";
  run.answer(0, 21 * 60);
  EXPECT_EQ(run.prompt(21 * 60).wants, Wants::GoOn);
  run.go_on(22 * 60);
  EXPECT_EQ(run.end(), LessonEnd::Finished);
}

TEST_F(LessonRunTest, OffersTheBreakBetweenTheTrialsOfALongStepToo) {
  LessonStep blind = step_of(StepKind::Identify, {0, 1});
  blind.trials = 6;
  lesson_.steps = {blind};
  auto run = this->run();
  const auto trial = [&](double now_s) {
    feel(run, static_cast<std::int32_t>(*run.prompt(now_s).material), now_s);
    run.answer(0, now_s + 2);
  };
  trial(600);
  trial(1199);
  ASSERT_EQ(run.prompt(1201).answers.size(), 2U);
  EXPECT_FALSE(run.prompt(1201).in_step) << "a break, no trial";
  run.answer(0, 1500);
  EXPECT_THAT(run.prompt(1500).progress, HasSubstr("trial 3 of 6"));
  trial(1510);
  ASSERT_EQ(rows_.size(), 3U);
  EXPECT_DOUBLE_EQ(rows_[2].onset_s, 1500) << "the break is no part of the trial";
  for (const double now_s : {1520.0, 1530.0, 1540.0}) trial(now_s);
  EXPECT_EQ(run.end(), LessonEnd::Finished);
}

TEST_F(LessonRunTest, OffersTheBreakToSomebodyWhoStaysOnATextOrAQuestion) {
  lesson_.steps = {step_of(StepKind::Text), step_of(StepKind::Question)};
  lesson_.steps[1].questionnaire = Questionnaire::Tlx;
  auto run = this->run();
  run.watch_time(1199);
  EXPECT_EQ(run.prompt(1199).wants, Wants::GoOn);
  run.watch_time(1200);
  ASSERT_EQ(run.prompt(1200).answers.size(), 2U);
  run.answer(1, 1201);  // no effect, since the key was meant for the prompt before
  run.answer(0, 1300);
  EXPECT_EQ(run.prompt(1300).wants, Wants::GoOn) << "nor does it end the break";
  run.go_on(1310);
  run.answer(3, 1320);
  run.watch_time(2500);
  EXPECT_FALSE(run.prompt(2500).in_step) << "a break, no item";
  run.answer(0, 2600);
  EXPECT_EQ(run.prompt(2600).item, "tlx-2") << "the answer to the first item is kept";
  for (int item = 1; item < 6; ++item) run.answer(4, 2610);
  EXPECT_EQ(run.end(), LessonEnd::Finished);
  EXPECT_DOUBLE_EQ(rows_.at(0).onset_s, 1300);
  EXPECT_EQ(rows_.at(1).response, "15");
  EXPECT_DOUBLE_EQ(*rows_.at(2).rt_s, 10) << "the break is no time of thought";
}

TEST_F(LessonRunTest, CutsNoTrialOfWhichSomethingIsFeltBeforeTwoMinutesMore) {
  lesson_.steps = {step_of(StepKind::Identify, {0})};
  auto run = this->run();
  run.force_is(HandForce::Full, 0);
  run.happened(event(physics::EventKind::JumpToContact, 0), 1190);
  run.watch_time(1205);
  run.go_on(1206);
  EXPECT_TRUE(run.prompt(1206).in_step) << "the tip is in contact";
  run.happened(event(physics::EventKind::JumpOffContact, 0), 1210);
  run.watch_time(1319);
  EXPECT_EQ(run.prompt(1319).words, test::english()[Phrase::LessonWhich]);
  run.watch_time(1320);
  run.answer(0, 1400);
  EXPECT_EQ(run.prompt(1400).wants, Wants::Cycle) << "the sample is felt again";
  EXPECT_TRUE(rows_.empty());
  lesson_.steps = {step_of(StepKind::Draw)};
  auto drawing = this->run();
  drawing.answer(0, 10);
  drawing.watch_time(1300);
  EXPECT_TRUE(drawing.prompt(1300).in_step) << "one part is answered";
}

TEST_F(LessonRunTest, ScoresACurveByTheShareOfItsPartsThatAreRight) {
  lesson_.steps = {step_of(StepKind::Draw)};
  auto run = this->run({.seed = 9});
  std::vector<std::string> offered;
  for (int part = 0; part < 5; ++part) {
    const LessonPrompt prompt = run.prompt(0);
    EXPECT_TRUE(prompt.hidden) << "the curve on the wall is the answer";
    ASSERT_EQ(prompt.answers.size(), 5U);
    offered.push_back(prompt.answers[prompt.right]);
    run.answer(part == 2 ? (prompt.right + 1) % 5 : prompt.right, part + 1.0);
  }
  EXPECT_EQ(offered.front(), test::english()[Phrase::DrawShape1]);
  EXPECT_EQ(offered.back(), test::english()[Phrase::DrawShape5]);
  ASSERT_EQ(rows_.size(), 1U);
  EXPECT_EQ(rows_[0].response, "0.8");
}

TEST_F(LessonRunTest, ATrialThatCannotBeKeptEndsTheLesson) {
  lesson_.steps = {step_of(StepKind::Text), step_of(StepKind::Text)};
  LessonRun run(
      lesson_, samples_, test::english(), {},
      [](const TrialRow&) -> core::Result<void> { return core::failure(core::ErrorCategory::Failed, "disk full"); }, 0);
  run.go_on(1);
  ASSERT_TRUE(run.error());
  EXPECT_EQ(run.error()->message, "disk full");
  EXPECT_EQ(run.prompt(2).wants, Wants::Nothing);
}

// Simulated students show the abilities that they were given, within the chance of so many trials.
TEST_F(LessonRunTest, SimulatedStudentsHaveTheAbilitiesTheyAreGiven) {
  lesson_.steps = {step_of(StepKind::Identify, {0, 1}), step_of(StepKind::Threshold, {1})};
  lesson_.steps[0].trials = lesson_.steps[1].trials = 200;
  lesson_.steps[1].threshold = {.start = 0.2, .least = 0.1999, .most = 0.2001, .step = 1.0001};
  int identified = 0, told = 0, trials = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    rows_.clear();
    auto run = this->run({.seed = seed});
    SimulatedStudent student({.seed = seed, .abilities = {.d_prime = 1.0, .weber_fraction = 0.2}}, lesson_, samples_);
    const auto taken = student.take(run);
    ASSERT_TRUE(taken) << taken.error().message;
    for (const TrialRow& row : rows_) {
      (row.kind == StepKind::Identify ? identified : told) += *row.correct ? 1 : 0;
      trials += row.kind == StepKind::Identify ? 1 : 0;
    }
  }
  ASSERT_EQ(trials, 1000);
  EXPECT_NEAR(identified / 1000.0, 0.7602, 0.05) << "Phi(1/sqrt 2)";
  EXPECT_NEAR(told / 1000.0, 0.75, 0.05) << "at the Weber fraction";
}

TEST_F(LessonRunTest, ABiasedStudentPrefersTheFirst) {
  lesson_.steps = {step_of(StepKind::Identify, {0, 1})};
  lesson_.steps[0].trials = 200;
  auto run = this->run();
  SimulatedStudent student({.seed = 1, .abilities = {.d_prime = 1.0, .bias = 1.5}}, lesson_, samples_);
  ASSERT_TRUE(student.take(run));
  int first = 0;
  for (const TrialRow& row : rows_) first += row.response == "mica" ? 1 : 0;
  EXPECT_GT(first, 140);
}

TEST(SimulatedParticipant, IsReadFromItsText) {
  const auto plain = SimulatedParticipant::parse("7");
  ASSERT_TRUE(plain);
  EXPECT_TRUE(is_participant_code(plain->code()));
  EXPECT_EQ(plain->code(), SimulatedParticipant::parse("7,bias=1")->code());
  EXPECT_NE(plain->code(), SimulatedParticipant::parse("8")->code());
  const auto able = SimulatedParticipant::parse("7,d-prime=2,weber=0.08,bias=-0.5");
  ASSERT_TRUE(able);
  EXPECT_EQ(able->abilities.d_prime, 2.0);
  EXPECT_EQ(able->abilities.weber_fraction, 0.08);
  EXPECT_EQ(able->abilities.bias, -0.5);
  for (const char* wrong : {"", "x", "-1", "7,", "7,speed=3", "7,weber", "7,weber=0", "7,d-prime=2x", "7 "}) {
    EXPECT_FALSE(SimulatedParticipant::parse(wrong)) << wrong;
  }
}

}  // namespace lesson_run_test
}  // namespace afm::exhibit
