// SPDX-License-Identifier: Apache-2.0
// How often the report's 95 % intervals hold the truth: a thousand simulated people with 40 trials each.
// Invariant: 95 % intervals of a study are right in at least 93 of 100 simulated cases, exact ones in 95
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "answers_second.h"
#include "study/detection.h"
#include "study/proportions.h"
#include "study/threshold.h"

namespace afm::study {
namespace coverage_test {

constexpr int kPeople = 1000;
constexpr std::size_t kTrials = 40;

// Random numbers that are the same with every standard library.
class Chance {
 public:
  explicit Chance(unsigned seed) : random_(seed) {}
  double share() { return (static_cast<double>(random_()) + 0.5) / 4294967296.0; }
  bool happens(double probability) { return share() < probability; }
  std::size_t times(std::size_t trials, double probability) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < trials; ++i) count += happens(probability) ? 1U : 0U;
    return count;
  }

 private:
  std::mt19937 random_;
};

TEST(CoverageOfTheReport, OfExactProportionsAndTheirDPrimesIsNinetyFivePercent) {
  Chance chance(1);
  for (const double d_prime : {0.0, 0.5, 1.0, 2.0, 3.0}) {
    int of_two = 0, of_three = 0, of_share = 0;
    const double two = choice_proportion(d_prime, 2), three = choice_proportion(d_prime, 3);
    std::vector<Interval> among_three;  // intervals by the number of right answers
    for (std::size_t right = 0; right <= kTrials; ++right) {
      among_three.push_back(choice_estimate(right, kTrials, 3).interval);
    }
    for (int person = 0; person < kPeople; ++person) {
      const std::size_t right = chance.times(kTrials, two);
      of_share += proportion(right, kTrials).interval.holds(two) ? 1 : 0;
      of_two += two_interval_estimate(right, kTrials).interval.holds(d_prime) ? 1 : 0;
      of_three += among_three[chance.times(kTrials, three)].holds(d_prime) ? 1 : 0;
    }
    EXPECT_GE(of_share, 950) << d_prime;
    EXPECT_GE(of_two, 950) << d_prime;
    EXPECT_GE(of_three, 950) << d_prime;
  }
}

TEST(CoverageOfTheReport, OfYesNoIsNinetyThreePercent) {
  Chance chance(2);
  for (const double d_prime : {0.5, 1.0, 2.0}) {
    for (const double criterion : {0.0, 0.4}) {
      const double hit = 0.5 * std::erfc(-(0.5 * d_prime - criterion) / std::sqrt(2.0));
      const double alarm = 0.5 * std::erfc(-(-0.5 * d_prime - criterion) / std::sqrt(2.0));
      int of_d_prime = 0, of_criterion = 0;
      for (int person = 0; person < kPeople; ++person) {
        const YesNo answers =
            yes_no({chance.times(kTrials / 2, hit), kTrials / 2, chance.times(kTrials / 2, alarm), kTrials / 2},
                   RateCorrection::LogLinear);
        of_d_prime += answers.d_prime_interval.holds(d_prime) ? 1 : 0;
        of_criterion += answers.criterion_interval.holds(criterion) ? 1 : 0;
      }
      EXPECT_GE(of_d_prime, 930) << d_prime << " " << criterion;
      EXPECT_GE(of_criterion, 930) << d_prime << " " << criterion;
    }
  }
}

struct Observer {
  double weber_fraction, exponent, bias;
};

// Kaernbach's weighted staircase, which converges where 75 % are right; steps of the level in decibels.
std::vector<ThresholdTrial> staircase(const Observer& observer, Chance& chance) {
  constexpr double kDown = 0.04, kUp = 3.0 * kDown;  // steps in log10
  std::vector<ThresholdTrial> trials;
  double log_level = std::log10(observer.weber_fraction) + 0.4;
  for (std::size_t i = 0; i < kTrials; ++i) {
    ThresholdTrial trial{.level = std::pow(10.0, log_level), .second_stronger = chance.happens(0.5)};
    trial.answered_second =
        chance.happens(answers_second_probability(trial, observer.weber_fraction, observer.exponent, observer.bias));
    log_level += trial.right() ? -kDown : kUp;
    trials.push_back(trial);
  }
  return trials;
}

TEST(CoverageOfTheReport, OfWeberFractionAndBiasIsNinetyThreePercent) {
  Chance chance(3);
  for (const Observer& observer : {Observer{0.1, 1.0, 0.0}, Observer{0.08, 2.5, 0.4}}) {
    int of_weber = 0, of_bias = 0;
    std::vector<double> errors;
    for (int person = 0; person < kPeople; ++person) {
      const ThresholdFit fit = fitted_threshold(staircase(observer, chance));
      of_weber += fit.weber_fraction.interval.holds(observer.weber_fraction) ? 1 : 0;
      of_bias += fit.bias.interval.holds(observer.bias) ? 1 : 0;
      errors.push_back(std::log10(fit.weber_fraction.value / observer.weber_fraction));
    }
    EXPECT_GE(of_weber, 930) << observer.exponent;
    EXPECT_GE(of_bias, 930) << observer.exponent;
    std::nth_element(errors.begin(), errors.begin() + kPeople / 2, errors.end());
    EXPECT_NEAR(errors[kPeople / 2], 0.0, 0.06) << "half of the estimates lie above the truth";
  }
}

}  // namespace coverage_test
}  // namespace afm::study
