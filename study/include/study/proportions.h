// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "study/interval.h"

namespace afm::study {

// Counts of right answers. Pure functions; any thread.

// Probability of at least `right` of `trials` if each is right with `chance`: I_chance(right, trials - right + 1), the
// exact binomial test, one-sided.
double p_of_at_least(std::size_t right, std::size_t trials, double chance);

// The smallest number of right answers that has a probability of at most alpha by chance; empty if even all of them are
// too probable.
struct SmallestCount {
  std::size_t right = 0;
  double p = 1.0;
};
std::optional<SmallestCount> smallest_count_above_chance(std::size_t trials, double chance, double alpha);

// The exact interval of Clopper & Pearson 1934: quantiles of the beta distribution. It contains the true value in at
// least 95 % of all cases, for any true value.
Estimate proportion(std::size_t right, std::size_t trials);

// The exact test of pairs that differ (sign test; McNemar 1947 for changes): twice the smaller tail at 1/2, at most 1.
// The effect is the share of increases, with its exact interval.
TestResult sign_test(std::size_t up, std::size_t down);
// The sign test of differences, ignoring zeros.
TestResult sign_test(std::span<const double> differences);

}  // namespace afm::study
