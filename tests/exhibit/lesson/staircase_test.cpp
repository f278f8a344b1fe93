// SPDX-License-Identifier: Apache-2.0
// Staircases, orders and questionnaires against published numbers.
// Invariant: staircases go through the published levels, and Williams designs are balanced
#include "exhibit/lesson/staircase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/enumerators.h"
#include "exhibit/lesson/lesson_random.h"
#include "exhibit/lesson/questionnaire.h"
#include "exhibit/lesson/williams.h"
#include "support/phrases.h"

namespace afm::exhibit {
namespace staircase_test {

// E22: PsychoPy's tests/test_data/test_StairHandlers.py, test_StairHandlerLinear.
TEST(UpDownStaircase, GoesThroughTheLevelsOfPsychoPy) {
  const std::vector<double> expected{0.8,  0.7,   0.6,   0.5,  0.4,   0.41,  0.42,  0.43,  0.44,  0.44,
                                     0.44, 0.439, 0.439, 0.44, 0.441, 0.442, 0.443, 0.443, 0.443, 0.442};
  UpDownStaircase staircase(0.8, {.up = 1, .down = 3, .steps = {0.1, 0.01, 0.001}, .least = 0, .most = 1});
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(staircase.level(), expected[i], 1e-9) << "trial " << i + 1;
    staircase.answer((i / 4) % 2 == 0);
  }
}

TEST(UpDownStaircase, NeedsThreeRightAnswersAfterARunThatBeganWrong) {
  UpDownStaircase staircase(0.5, {.up = 1, .down = 3, .steps = {0.1, 0.01}, .least = 0, .most = 1});
  staircase.answer(false);
  EXPECT_NEAR(staircase.level(), 0.6, 1e-12);
  staircase.answer(true);  // a reversal, which PsychoPy does not follow with a step
  staircase.answer(true);
  EXPECT_NEAR(staircase.level(), 0.6, 1e-12);
  staircase.answer(true);
  EXPECT_NEAR(staircase.level(), 0.59, 1e-12);
}

TEST(UpDownStaircase, StaysWithinItsLevels) {
  UpDownStaircase staircase(0.2, {.up = 1, .down = 3, .steps = {0.1}, .least = 0.1, .most = 0.3});
  for (int i = 0; i < 9; ++i) staircase.answer(true);
  EXPECT_NEAR(staircase.level(), 0.1, 1e-12);
  for (int i = 0; i < 9; ++i) staircase.answer(false);
  EXPECT_NEAR(staircase.level(), 0.3, 1e-12);
}

// E21: up by three steps after a wrong answer, down by one after a right one: in balance at 3 of 4.
TEST(WeightedStaircase, HoversWhereThreeAnswersInFourAreRight) {
  WeightedStaircase staircase(0.0, {.step = 0.1, .weight = 3, .least = -9, .most = 9});
  staircase.answer(true);
  EXPECT_NEAR(staircase.level(), -0.2, 1e-12) << "doubled until the first wrong answer";
  staircase.answer(false);
  const double level = staircase.level();
  for (const bool right : {true, true, true, false}) staircase.answer(right);
  EXPECT_NEAR(staircase.level(), level, 1e-12);
  // an observer whose share of right answers rises with the level
  LessonRandom random(1);
  double right = 0;
  constexpr int kTrials = 20'000;
  for (int i = 0; i < kTrials; ++i) {
    const bool hit = random.unit() < 0.5 + 0.5 / (1.0 + std::exp(-4.0 * staircase.level()));
    right += hit ? 1 : 0;
    staircase.answer(hit);
  }
  EXPECT_NEAR(right / kTrials, 0.75, 0.005);
}

// E24: PsychoPy's test_QuestHandler.
TEST(QuestStaircase, EstimatesWhatPsychoPyEstimates) {
  QuestStaircase quest({.guess = 50,
                        .guess_sd = 50,
                        .share = 0.82,
                        .beta = 3.5,
                        .delta = 0.01,
                        .gamma = 0.5,
                        .grain = 0.01,
                        .range = 100,
                        .least = 0,
                        .most = 100});
  EXPECT_DOUBLE_EQ(quest.level(), 50.0);
  for (const bool right : {true, true, false, false, true, true, false, false, true, true}) quest.answer(right);
  EXPECT_NEAR(quest.quantile(), 86.38490311, 1e-4 * 86.0);
}

TEST(Staircases, OfEveryRuleGoDownToTheThresholdOfAnObserver) {
  for (const StaircaseRule rule : core::kEnumerators<StaircaseRule>) {
    ThresholdPlan plan;
    plan.rule = rule;
    plan.start = 0.6;
    const auto staircase = make_staircase(plan);
    LessonRandom random(2);
    double sum = 0;
    for (int i = 0; i < 200; ++i) {
      const double w = std::pow(10.0, staircase->level());
      EXPECT_GE(w, plan.least * 0.999);
      EXPECT_LE(w, plan.most * 1.001);
      staircase->answer(random.unit() < 1.0 - 0.5 * std::exp(-std::pow(w / 0.1, 2.0)));
      if (i >= 100) sum += staircase->level();
    }
    EXPECT_NEAR(std::pow(10.0, sum / 100), 0.1, 0.03) << core::index_of(rule);
  }
}

// E27.
TEST(WilliamsOrders, OfFourConditionsAreThePublishedSquare) {
  const std::vector<std::vector<std::size_t>> square{{0, 1, 3, 2}, {1, 2, 0, 3}, {2, 3, 1, 0}, {3, 0, 2, 1}};
  EXPECT_EQ(williams_orders(4), square);
}

TEST(WilliamsOrders, ShowEveryConditionEverywhereAndAfterEveryOtherEquallyOften) {
  for (std::size_t n = 2; n <= 9; ++n) {
    const auto orders = williams_orders(n);
    EXPECT_EQ(orders.size(), n % 2 == 0 ? n : 2 * n) << "three conditions need six orders";
    std::map<std::pair<std::size_t, std::size_t>, std::size_t> places, pairs;
    for (const auto& order : orders) {
      ASSERT_EQ(order.size(), n);
      for (std::size_t i = 0; i < n; ++i) {
        ++places[{i, order[i]}];
        if (i > 0) ++pairs[{order[i - 1], order[i]}];
      }
    }
    EXPECT_EQ(places.size(), n * n);
    EXPECT_EQ(pairs.size(), n * (n - 1));
    for (const auto& [place, count] : places) EXPECT_EQ(count, orders.size() / n);
    for (const auto& [pair, count] : pairs) EXPECT_EQ(count, orders.size() / n);
  }
  EXPECT_EQ(williams_orders(1), (std::vector<std::vector<std::size_t>>{{0}}));
}

TEST(Questionnaires, HaveTheirItemsAndAnswersInBothLanguages) {
  for (const char* language : {"en", "de"}) {
    const Phrases phrases = Phrases::load(test::kPhraseFolder + language + ".toml").value();
    for (const QuestionnaireRow& row : kQuestionnaires) {
      const auto answers = answers_of(row.questionnaire, phrases);
      EXPECT_EQ(answers.size(), static_cast<std::size_t>((row.most - row.least) / row.step + 1));
      EXPECT_EQ(value_of(row.questionnaire, answers.size() - 1), row.most);
      EXPECT_EQ(row_of(row.first_item).key, std::string(row.word) + "-1");
      EXPECT_EQ(row_of(after(row.first_item, row.items - 1)).key, item_id(row.questionnaire, row.items - 1));
      EXPECT_NE(row_of(after(row.first_item, row.items)).key, item_id(row.questionnaire, row.items));
      for (std::size_t i = 0; i < row.items; ++i) EXPECT_FALSE(phrases[after(row.first_item, i)].empty());
    }
  }
}

}  // namespace staircase_test
}  // namespace afm::exhibit
