// SPDX-License-Identifier: Apache-2.0
#include "study/proportions.h"

#include <fmt/format.h>

#include <algorithm>

#include "distributions.h"

namespace afm::study {

double p_of_at_least(std::size_t right, std::size_t trials, double chance) {
  if (right == 0) return 1.0;
  if (right > trials) return 0.0;
  return beta_cdf(chance, static_cast<double>(right), static_cast<double>(trials - right) + 1.0);
}

std::optional<SmallestCount> smallest_count_above_chance(std::size_t trials, double chance, double alpha) {
  std::size_t low = 0, high = trials + 1;  // bounds: too probable, and improbable enough or impossible
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (p_of_at_least(middle, trials, chance) <= alpha ? high : low) = middle;
  }
  if (high > trials) return std::nullopt;
  return SmallestCount{high, p_of_at_least(high, trials, chance)};
}

Estimate proportion(std::size_t right, std::size_t trials) {
  Estimate result{.n = trials};
  if (trials == 0 || right > trials) return result;
  const auto k = static_cast<double>(right), n = static_cast<double>(trials);
  result.value = k / n;
  result.interval.low = right == 0 ? 0.0 : beta_quantile(0.5 * kIntervalAlpha, k, n - k + 1.0);
  result.interval.high = right == trials ? 1.0 : beta_quantile(1.0 - 0.5 * kIntervalAlpha, k + 1.0, n - k);
  return result;
}

TestResult sign_test(std::size_t up, std::size_t down) {
  TestResult test{.name = "sign test", .statistic = fmt::format("{} up, {} down", up, down)};
  test.effect_name = "share that went up";
  test.effect = proportion(up, up + down);
  if (up + down > 0) test.p = std::min(1.0, 2.0 * p_of_at_least(std::max(up, down), up + down, 0.5));
  return test;
}

TestResult sign_test(std::span<const double> differences) {
  const auto up = std::count_if(differences.begin(), differences.end(), [](double d) { return d > 0.0; });
  const auto down = std::count_if(differences.begin(), differences.end(), [](double d) { return d < 0.0; });
  return sign_test(static_cast<std::size_t>(up), static_cast<std::size_t>(down));
}

}  // namespace afm::study
