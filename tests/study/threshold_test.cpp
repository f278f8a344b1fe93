// SPDX-License-Identifier: Apache-2.0
// Weber fraction and bias of a staircase's trials.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "answers_second.h"
#include "study/threshold.h"

namespace afm::study {
namespace threshold_test {

TEST(Threshold, IsWhatPerfectDataWereMadeOf) {
  std::vector<ThresholdTrial> trials;
  for (const double level : {0.02, 0.05, 0.1, 0.2, 0.4}) {
    for (const bool second : {false, true}) {
      ThresholdTrial trial{.level = level, .second_stronger = second};
      const double p = answers_second_probability(trial, 0.1, 1.0, 0.2);
      constexpr int kMany = 1000;
      for (int i = 0; i < kMany; ++i) {
        trial.answered_second = i < std::lround(p * kMany);
        trials.push_back(trial);
      }
    }
  }
  const ThresholdFit fit = fitted_threshold(trials);
  EXPECT_NEAR(fit.weber_fraction.value, 0.1, 0.002);
  EXPECT_NEAR(fit.bias.value, 0.2, 0.02);
  EXPECT_LT(fit.weber_fraction.interval.high - fit.weber_fraction.interval.low, 0.015);
}

TEST(Threshold, IsNotBoundedByTrialsThatSayNothing) {
  const std::vector<ThresholdTrial> all_right(20, {.level = 0.3, .second_stronger = true, .answered_second = true});
  EXPECT_EQ(fitted_threshold(all_right).weber_fraction.interval.low, 0.0);
  const std::vector<ThresholdTrial> few(4, {.level = 0.3, .second_stronger = true, .answered_second = true});
  EXPECT_TRUE(std::isnan(fitted_threshold(few).weber_fraction.value));
  EXPECT_TRUE(std::isnan(fitted_threshold({}).bias.value));
  const std::vector<ThresholdTrial> nothing(20, {.level = 0.0, .second_stronger = true, .answered_second = true});
  EXPECT_TRUE(std::isnan(fitted_threshold(nothing).weber_fraction.value));
}

}  // namespace threshold_test
}  // namespace afm::study
