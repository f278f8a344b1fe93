// SPDX-License-Identifier: Apache-2.0
#include "study/detection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "distributions.h"
#include "study/proportions.h"

namespace afm::study {

namespace {

constexpr double kLargestDPrime = 12.0;

struct ZRate {
  double value = kNoValue;
  double z = kNoValue;
  double variance = kNoValue;  // variance of the z value
};

ZRate z_rate_of(std::size_t count, std::size_t trials, RateCorrection correction) {
  const bool corrected = correction == RateCorrection::LogLinear;
  const double n = static_cast<double>(trials) + (corrected ? 1.0 : 0.0);
  ZRate rate;
  rate.value = (static_cast<double>(count) + (corrected ? 0.5 : 0.0)) / n;
  rate.z = normal_quantile(rate.value);
  const double density = normal_density(rate.z);
  rate.variance = rate.value * (1.0 - rate.value) / (n * density * density);
  return rate;
}

Interval interval_around(double value, double variance) {
  const double half = normal_quantile(1.0 - 0.5 * kIntervalAlpha) * std::sqrt(variance);
  return {value - half, value + half};
}

}  // namespace

double two_interval_d_prime(double right) { return std::numbers::sqrt2 * normal_quantile(right); }

double choice_proportion(double d_prime, int alternatives) {
  // for an integrand that decays this fast at both ends, the trapezium rule converges faster than any power of the step
  constexpr double kReach = 9.0, kStep = 0.05;
  double sum = 0.0;
  for (double u = -kReach; u <= kReach; u += kStep) {
    sum += normal_density(u) * std::pow(normal_cdf(u + d_prime), alternatives - 1);
  }
  return kStep * sum;
}

double choice_d_prime(double right, int alternatives) {
  if (std::isnan(right)) return kNoValue;
  if (right >= 1.0) return std::numeric_limits<double>::infinity();
  double low = -kLargestDPrime, high = kLargestDPrime;
  if (right <= choice_proportion(low, alternatives)) return -std::numeric_limits<double>::infinity();
  for (int step = 0; step < 60; ++step) {
    const double middle = 0.5 * (low + high);
    (choice_proportion(middle, alternatives) < right ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Estimate two_interval_estimate(std::size_t right, std::size_t trials) {
  const Estimate share = proportion(right, trials);
  return {trials,
          two_interval_d_prime(share.value),
          {two_interval_d_prime(share.interval.low), two_interval_d_prime(share.interval.high)}};
}

Estimate choice_estimate(std::size_t right, std::size_t trials, int alternatives) {
  const Estimate share = proportion(right, trials);
  return {trials,
          choice_d_prime(share.value, alternatives),
          {choice_d_prime(share.interval.low, alternatives), choice_d_prime(share.interval.high, alternatives)}};
}

YesNo yes_no(const YesNoCounts& counts, RateCorrection correction) {
  if (counts.signals == 0 || counts.noises == 0) return {};
  const ZRate hits = z_rate_of(counts.hits, counts.signals, correction);
  const ZRate alarms = z_rate_of(counts.false_alarms, counts.noises, correction);
  YesNo result{.d_prime = hits.z - alarms.z, .criterion = -0.5 * (hits.z + alarms.z)};
  const double variance = hits.variance + alarms.variance;
  result.d_prime_interval = interval_around(result.d_prime, variance);
  result.criterion_interval = interval_around(result.criterion, 0.25 * variance);
  return result;
}

std::size_t ConfusionMatrix::trials() const {
  std::size_t sum = 0;
  for (const auto& row : counts) {
    for (const std::size_t count : row) sum += count;
  }
  return sum;
}

std::size_t ConfusionMatrix::right() const {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) sum += counts[i][i];
  return sum;
}

double ConfusionMatrix::accuracy() const {
  return trials() > 0 ? static_cast<double>(right()) / static_cast<double>(trials()) : kNoValue;
}

double ConfusionMatrix::kappa() const {
  const auto n = static_cast<double>(trials());
  double chance = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const YesNoCounts one = against_the_rest(i);
    chance += static_cast<double>(one.signals) / n * static_cast<double>(one.hits + one.false_alarms) / n;
  }
  return chance < 1.0 ? (accuracy() - chance) / (1.0 - chance) : kNoValue;
}

double ConfusionMatrix::information_bits() const {
  const auto n = static_cast<double>(trials());
  if (n == 0.0) return kNoValue;
  double bits = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto shown = static_cast<double>(against_the_rest(i).signals);
    for (std::size_t k = 0; k < counts.size(); ++k) {
      if (counts[i][k] == 0) continue;
      const YesNoCounts of_answer = against_the_rest(k);
      const auto both = static_cast<double>(counts[i][k]);
      const auto answered = static_cast<double>(of_answer.hits + of_answer.false_alarms);
      bits += both / n * std::log2(both * n / (shown * answered));
    }
  }
  return bits;
}

YesNoCounts ConfusionMatrix::against_the_rest(std::size_t name) const {
  YesNoCounts result;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (std::size_t k = 0; k < counts.size(); ++k) {
      (i == name ? result.signals : result.noises) += counts[i][k];
      if (k == name) (i == name ? result.hits : result.false_alarms) += counts[i][k];
    }
  }
  return result;
}

}  // namespace afm::study
