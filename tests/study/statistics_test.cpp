// SPDX-License-Identifier: Apache-2.0
// E01 to E31 are rows of the table of cases.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "study/detection.h"
#include "study/means.h"
#include "study/paper_survey.h"
#include "study/proportions.h"
#include "study/questionnaires.h"

namespace afm::study {
namespace statistics_test {

using ::testing::ElementsAre;

// The tolerance of a row that is relative.
void expect_relative(double actual, double expected, double tolerance) {
  EXPECT_NEAR(actual, expected, tolerance * std::abs(expected));
}

TEST(PaperSurvey, E01PrintsMeansAndDeviationsThatTwentyWholeAnswersCanHave) {
  std::vector<std::size_t> solutions;
  for (const SurveyQuestion& question : survey_questions()) {
    solutions.push_back(answers_that_print_as(question).size());
  }
  EXPECT_THAT(solutions, ElementsAre(1, 1, 1, 2, 2, 1, 1, 2));
}

TEST(PaperSurvey, E02HasTwoDistributionsForEachOfTheComparedQuestions) {
  EXPECT_THAT(answers_that_print_as(survey_questions()[kHapticsQuestion]),
              ElementsAre(AnswerCounts{0, 0, 4, 5, 11}, AnswerCounts{0, 1, 1, 8, 10}));
  EXPECT_THAT(answers_that_print_as(survey_questions()[kGraphicsQuestion]),
              ElementsAre(AnswerCounts{0, 0, 4, 9, 7}, AnswerCounts{0, 1, 1, 12, 6}));
}

TEST(PaperSurvey, E03DoesNotShowThatHapticsHelpMoreThanGraphics) {
  const TTest test = welch_test(printed_summary(survey_questions()[kHapticsQuestion]),
                                printed_summary(survey_questions()[kGraphicsQuestion]));
  expect_relative(test.t, 0.8102413562, 1e-6);
  expect_relative(test.degrees, 37.77712658, 1e-6);
  expect_relative(test.p, 0.4228763481, 1e-6);
  expect_relative(test.d.value, 0.256220814, 1e-6);
  EXPECT_TRUE(test.d.interval.holds(0.0));
}

TEST(PaperSurvey, E04NeedsTheKindestOfAllPairings) {
  const KindestPairing kindest = kindest_pairing(answers_that_print_as(survey_questions()[kHapticsQuestion]),
                                                 answers_that_print_as(survey_questions()[kGraphicsQuestion]));
  EXPECT_EQ(kindest.tables, 899U);
  EXPECT_NEAR(kindest.t.p, 0.04208628671, 1e-9);
  EXPECT_NEAR(kindest.sign.p, 0.0654296875, 1e-9);
}

TEST(Mean, E05HasStudentsInterval) {
  std::vector<double> answers(11, 4.0);
  answers.insert(answers.end(), 8, 3.0);
  answers.push_back(2.0);
  const Summary summary = summary_of(answers);
  EXPECT_NEAR(summary.mean, 3.5, 1e-9);
  EXPECT_NEAR(summary.sd, 0.6069769787, 1e-9);
  EXPECT_NEAR(t_interval(summary).low, 3.21592603, 1e-8);
  EXPECT_NEAR(t_interval(summary).high, 3.78407397, 1e-8);
}

TEST(Sus, E06ScoresAnExample) {
  EXPECT_DOUBLE_EQ(sus_score(std::array<double, 10>{4, 2, 5, 1, 4, 2, 4, 1, 5, 2}), 85.0);
}

TEST(Sus, E07ReachesFromNothingToAHundred) {
  std::array<double, 10> threes{}, fives{};
  threes.fill(3.0);
  fives.fill(5.0);
  EXPECT_DOUBLE_EQ(sus_score(threes), 50.0);
  EXPECT_DOUBLE_EQ(sus_score(std::array<double, 10>{5, 1, 5, 1, 5, 1, 5, 1, 5, 1}), 100.0);
  EXPECT_DOUBLE_EQ(sus_score(fives), 50.0);
}

TEST(Tlx, IsTheMeanOfSix) {
  const std::array<double, 6> ratings{70, 20, 60, 30, 80, 40};
  EXPECT_DOUBLE_EQ(tlx_raw(ratings), 50.0);
}

TEST(Ssq, E09CountsItemsOfTwoScalesTwice) {
  std::array<double, 16> slight{};
  slight.fill(1.0);
  const SsqScores scores = ssq_scores(slight);
  EXPECT_NEAR(scores.nausea, 66.78, 1e-9);
  EXPECT_NEAR(scores.oculomotor, 53.06, 1e-9);
  EXPECT_NEAR(scores.disorientation, 97.44, 1e-9);
  EXPECT_NEAR(scores.total, 78.54, 1e-9);
}

TEST(Ssq, E10ScoresAnExample) {
  const SsqScores scores = ssq_scores(std::array<double, 16>{1, 1, 2, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0});
  EXPECT_NEAR(scores.nausea, 19.08, 1e-9);
  EXPECT_NEAR(scores.oculomotor, 45.48, 1e-9);
  EXPECT_NEAR(scores.disorientation, 55.68, 1e-9);
  EXPECT_NEAR(scores.total, 44.88, 1e-9);
}

TEST(Ssq, SaysStopAboveTwentyAndAtAnythingSevere) {
  std::array<double, 16> answers{};
  answers[12] = answers[13] = 2.0;  // total 14.96
  EXPECT_FALSE(ssq_says_stop(answers));
  answers[12] = 3.0;
  EXPECT_TRUE(ssq_says_stop(answers));
  answers[12] = answers[7] = 2.0;  // total 29.92
  EXPECT_TRUE(ssq_says_stop(answers));
}

TEST(DPrime, E11OfTwoIntervals) {
  expect_relative(two_interval_d_prime(0.75), 0.9538725524, 1e-9);
  const Estimate estimate = two_interval_estimate(30, 40);
  expect_relative(estimate.value, 0.9538725524, 1e-9);
  EXPECT_TRUE(estimate.interval.holds(0.5) && !estimate.interval.holds(0.0)) << estimate.interval.low;
}

TEST(DPrime, E13GivesTheProportionOfAChoiceAmongThree) {
  expect_relative(choice_proportion(1.0, 3), 0.6337020458, 1e-8);
  expect_relative(choice_proportion(2.0, 3), 0.8657671756, 1e-8);
  EXPECT_NEAR(choice_proportion(0.0, 7), 1.0 / 7.0, 1e-12);
  EXPECT_NEAR(choice_proportion(1.3, 2), 0.5 * std::erfc(-1.3 / 2.0), 1e-12) << "two is the pair of intervals";
}

TEST(DPrime, OfAChoiceIsTheInverseOfItsProportion) {
  for (const int alternatives : {2, 3, 5}) {
    for (const double d_prime : {-0.5, 0.0, 0.7, 2.5, 4.0}) {
      EXPECT_NEAR(choice_d_prime(choice_proportion(d_prime, alternatives), alternatives), d_prime, 1e-9);
    }
  }
  EXPECT_TRUE(std::isinf(choice_d_prime(1.0, 3)));
  EXPECT_TRUE(std::isinf(choice_estimate(12, 12, 3).interval.high));
  EXPECT_GT(choice_estimate(12, 12, 3).interval.low, 1.0);
}

TEST(YesNo, E15StaysFiniteWithoutMisses) {
  const YesNo answers = yes_no({20, 20, 0, 20}, RateCorrection::LogLinear);
  expect_relative(answers.d_prime, 3.961504793, 1e-9);
  EXPECT_NEAR(answers.criterion, 0.0, 1e-12);
  EXPECT_TRUE(std::isfinite(answers.d_prime_interval.high));
  EXPECT_TRUE(std::isinf(yes_no({20, 20, 0, 20}, RateCorrection::None).d_prime));
}

ConfusionMatrix matrix_of_the_case() { return {{"mica", "gold", "si3n4"}, {{14, 4, 2}, {3, 12, 5}, {1, 6, 13}}}; }

TEST(ConfusionMatrix, E16HasAccuracyKappaAndInformation) {
  expect_relative(matrix_of_the_case().accuracy(), 0.65, 1e-9);
  expect_relative(matrix_of_the_case().kappa(), 0.475, 1e-9);
  expect_relative(matrix_of_the_case().information_bits(), 0.3632596791, 1e-9);
}

TEST(ConfusionMatrix, E19TakesOneMaterialAgainstTheRest) {
  const YesNoCounts gold = matrix_of_the_case().against_the_rest(1);
  EXPECT_EQ(gold.hits, 12U);
  EXPECT_EQ(gold.signals, 20U);
  EXPECT_EQ(gold.false_alarms, 10U);
  EXPECT_EQ(gold.noises, 40U);
  const YesNo answers = yes_no(gold, RateCorrection::None);
  expect_relative(answers.d_prime, 0.9278368533, 1e-9);
  expect_relative(answers.criterion, 0.2105713235, 1e-9);
}

TEST(ConfusionMatrix, OfNoTrialsHasNoScore) {
  const ConfusionMatrix empty{{"mica", "gold"}, {{0, 0}, {0, 0}}};
  EXPECT_TRUE(std::isnan(empty.accuracy()));
  EXPECT_TRUE(std::isnan(empty.information_bits()));
  EXPECT_TRUE(std::isnan(empty.kappa()));
}

TEST(Binomial, E18NeedsEightOfTwelve) {
  const auto smallest = smallest_count_above_chance(12, 1.0 / 3.0, 0.05);
  ASSERT_TRUE(smallest.has_value());
  EXPECT_EQ(smallest->right, 8U);
  EXPECT_NEAR(smallest->p, 0.01875843226, 1e-9);
  EXPECT_FALSE(smallest_count_above_chance(4, 0.5, 0.05).has_value()) << "1/16 is not rare enough";
  EXPECT_EQ(smallest_count_above_chance(5, 0.5, 0.05)->right, 5U);
}

TEST(Binomial, OfChanceIsTheSumOfItsTerms) {
  double sum = 0.0;
  for (int k = 7; k <= 10; ++k) sum += std::tgamma(11) / (std::tgamma(k + 1) * std::tgamma(11 - k)) / 1024.0;
  EXPECT_NEAR(p_of_at_least(7, 10, 0.5), sum, 1e-12);
  EXPECT_DOUBLE_EQ(p_of_at_least(0, 10, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(p_of_at_least(11, 10, 0.5), 0.0);
}

TEST(Binomial, IntervalOfNoneAndOfAllIsThatOfThreeInN) {
  EXPECT_DOUBLE_EQ(proportion(0, 20).interval.low, 0.0);
  EXPECT_NEAR(proportion(0, 20).interval.high, 1.0 - std::pow(0.025, 1.0 / 20.0), 1e-12);
  EXPECT_NEAR(proportion(20, 20).interval.low, std::pow(0.025, 1.0 / 20.0), 1e-12);
  EXPECT_TRUE(std::isnan(proportion(0, 0).value));
}

TEST(NormalisedGain, E29IsTheShareOfWhatWasLeftToLearn) {
  EXPECT_NEAR(normalised_gain(0.45, 0.72), 0.4909090909, 1e-9);
  EXPECT_TRUE(std::isnan(normalised_gain(1.0, 1.0)));
}

TEST(CronbachAlpha, E30OfSixPeopleAndThreeItems) {
  expect_relative(cronbach_alpha({{4, 3, 4}, {3, 3, 3}, {4, 4, 4}, {2, 3, 2}, {3, 4, 3}, {4, 4, 3}}), 0.78125, 1e-9);
  EXPECT_TRUE(std::isnan(cronbach_alpha({{4, 4}, {4, 4}}))) << "nobody differs";
}

TEST(SignTest, E31IsMcNemarsOfThoseThatChanged) {
  const TestResult test = sign_test(9, 2);
  EXPECT_NEAR(test.p, 0.0654296875, 1e-9);
  EXPECT_NEAR(test.effect.value, 9.0 / 11.0, 1e-12);
  EXPECT_DOUBLE_EQ(sign_test(3, 3).p, 1.0);
  EXPECT_TRUE(std::isnan(sign_test(0, 0).p));
}

TEST(PairedTest, IsThatOfTheDifferences) {
  const TTest test = paired_test(std::array{1.0, 2.0, 0.0, 3.0, 1.0});
  EXPECT_NEAR(test.t, 1.4 / (std::sqrt(1.3) / std::sqrt(5.0)), 1e-12);
  EXPECT_DOUBLE_EQ(test.degrees, 4.0);
  EXPECT_NEAR(test.p, 0.051606, 1e-6);  // its closed form for 4 degrees
  EXPECT_TRUE(std::isnan(paired_test(std::array{2.0, 2.0}).p)) << "without spread there is no t";
}

TEST(EffectSize, HasTheIntervalOfTheNoncentralT) {
  const Interval interval = standardised_interval(0.0, 18.0, 1.0);
  EXPECT_NEAR(interval.low, -1.959964, 1e-6) << "a noncentral t of 0 is the normal distribution's";
  EXPECT_NEAR(interval.high, 1.959964, 1e-6);
  const Interval of_d = welch_test({20, 0.5, 1.0}, {20, 0.0, 1.0}).d.interval;
  EXPECT_LT(of_d.low, 0.0);
  EXPECT_NEAR(0.5 * (of_d.low + of_d.high), 0.5, 0.02);
}

// The hand-written study of two measures, whose correction once changed nothing because it was done per measure.
TEST(Holm, CorrectsTestsThatStandSideBySide) {
  TestResult first{.name = "a", .p = 0.0204, .effect = {}}, second{.name = "b", .p = 0.169, .effect = {}};
  TestResult without_p{.name = "c", .effect = {}};
  correct_by_holm(std::array{&first, &without_p, &second});
  EXPECT_NEAR(first.holm_p, 0.0408, 1e-12);
  EXPECT_NEAR(second.holm_p, 0.169, 1e-12);
  EXPECT_TRUE(std::isnan(without_p.holm_p));
  TestResult alone{.name = "d", .p = 0.03, .effect = {}};
  correct_by_holm(std::array{&alone});
  EXPECT_TRUE(std::isnan(alone.holm_p)) << "nothing stands beside it";
}

TEST(Holm, RejectsInTheOrderOfP) {
  EXPECT_THAT(holm_adjusted(std::array{0.04, 0.01, 0.03}),
              ElementsAre(::testing::DoubleNear(0.06, 1e-12), ::testing::DoubleNear(0.03, 1e-12),
                          ::testing::DoubleNear(0.06, 1e-12)));
}

}  // namespace statistics_test
}  // namespace afm::study
