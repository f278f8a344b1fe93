// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace afm::study {

inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kUnbounded = std::numeric_limits<double>::infinity();

// All confidence intervals of a study are 95 %.
inline constexpr double kIntervalAlpha = 0.05;

// Interval whose end is infinite if unbounded, and NaN if undefined.
struct Interval {
  double low = kNoValue;
  double high = kNoValue;

  bool holds(double value) const { return low <= value && value <= high; }

  // The part within a scale that contains the true value, which preserves the coverage. NaN stays.
  Interval within(const Interval& scale) const {
    const auto clamped = [&](double end) { return std::isnan(end) ? end : std::clamp(end, scale.low, scale.high); };
    return {clamped(low), clamped(high)};
  }
};

inline constexpr Interval kShares{0.0, 1.0}, kNotNegative{0.0, kUnbounded};

// An estimate from `n` people or trials.
struct Estimate {
  std::size_t n = 0;
  double value = kNoValue;
  Interval interval{};
};

// The result of a test. The only type with a p value, so that none is reported without its effect size and interval.
struct TestResult {
  std::string name;         // name of the test, "paired t"
  std::string statistic{};  // text of the statistic, "t(19) = 2.18"
  double p = kNoValue;      // p value, two-sided unless the name says one-sided
  std::string effect_name{};
  Estimate effect{};
  double holm_p = kNoValue;  // p corrected for the tests reported with it (Holm); NaN for a single test
};

}  // namespace afm::study
