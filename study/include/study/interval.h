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

// All intervals of a study are of 95 %.
inline constexpr double kIntervalAlpha = 0.05;

// An end that the data do not bound is infinite; one that cannot be computed is NaN.
struct Interval {
  double low = kNoValue;
  double high = kNoValue;

  bool holds(double value) const { return low <= value && value <= high; }

  // What of it can be: a truth that lies within its scale is held as before. NaN stays.
  Interval within(const Interval& scale) const {
    const auto clamped = [&](double end) { return std::isnan(end) ? end : std::clamp(end, scale.low, scale.high); };
    return {clamped(low), clamped(high)};
  }
};

inline constexpr Interval kShares{0.0, 1.0}, kNotNegative{0.0, kUnbounded};

// A number that was estimated from `n` people or trials.
struct Estimate {
  std::size_t n = 0;
  double value = kNoValue;
  Interval interval{};
};

// The result of a test. A p has no other home, so that none is reported without its effect size and interval.
struct TestResult {
  std::string name;         // "paired t"
  std::string statistic{};  // "t(19) = 2.18"
  double p = kNoValue;      // two-sided unless the name says one-sided
  std::string effect_name{};
  Estimate effect{};
};

}  // namespace afm::study
