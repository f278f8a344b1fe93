// SPDX-License-Identifier: Apache-2.0
#include "physics/normal_generator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace afm::physics {
namespace normal_generator_test {

// Enough for the tail, which begins at 3.65, to be met some 2600 times.
constexpr int kCount = 10'000'000;

TEST(NormalGenerator, HasTheMomentsOfTheNormalDistribution) {
  NormalGenerator normal(20260101);
  std::array<double, 5> sums{};
  for (int i = 0; i < kCount; ++i) {
    const double x = normal();
    double to_the_power = 1.0;
    for (std::size_t power = 1; power < sums.size(); ++power) sums[power] += to_the_power *= x;
  }
  // five standard errors: the variance of x^n is the moment 2n less the square of the moment n
  const double error = 5.0 / std::sqrt(kCount);
  EXPECT_NEAR(sums[1] / kCount, 0.0, error);
  EXPECT_NEAR(sums[2] / kCount, 1.0, error * std::sqrt(2.0));
  EXPECT_NEAR(sums[3] / kCount, 0.0, error * std::sqrt(15.0));
  EXPECT_NEAR(sums[4] / kCount, 3.0, error * std::sqrt(96.0));
}

// Pearson's chi squared over bins that cut the ziggurat's layers and its tail alike.
TEST(NormalGenerator, FillsEveryBinAsTheBellDoes) {
  constexpr double kWidth = 0.1;
  constexpr std::size_t kBins = 100;  // from -5 to 5; beyond, the outermost take all
  std::array<int, kBins> counts{};
  NormalGenerator normal(7);
  for (int i = 0; i < kCount; ++i) {
    const double bin = std::floor(normal() / kWidth) + kBins / 2.0;
    ++counts[static_cast<std::size_t>(std::min(std::max(bin, 0.0), kBins - 1.0))];
  }
  const auto below = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
  double chi_squared = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    const double left = (static_cast<double>(bin) - kBins / 2.0) * kWidth;
    const double expected = kCount * ((bin + 1 == kBins ? 1.0 : below(left + kWidth)) - (bin == 0 ? 0.0 : below(left)));
    chi_squared += std::pow(counts[bin] - expected, 2) / expected;
  }
  // 99 degrees of freedom: beyond 161 once in ten thousand seeds
  EXPECT_LT(chi_squared, 161.0);
}

TEST(NormalGenerator, RepeatsItselfForTheSameSeedOnly) {
  NormalGenerator first(3), again(3), other(4);
  int alike = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = first();
    EXPECT_EQ(x, again());
    alike += x == other() ? 1 : 0;
  }
  EXPECT_EQ(alike, 0);
}

// Recorded sessions depend on this sequence: a replay on another machine gives the same forces.
TEST(NormalGenerator, IsTheSameEverywhere) {
  NormalGenerator normal(1);
  const std::array<double, 3> first{normal(), normal(), normal()};
  EXPECT_DOUBLE_EQ(first[0], 1.0991219651934032);
  EXPECT_DOUBLE_EQ(first[1], 1.0817251720063026);
  EXPECT_DOUBLE_EQ(first[2], -0.23993583808100583);
}

TEST(NormalGenerator, TakesZeroForASeed) {
  NormalGenerator normal(0);
  double sum = 0.0;
  for (int i = 0; i < 100; ++i) sum += std::abs(normal());
  EXPECT_GT(sum, 20.0);
}

}  // namespace normal_generator_test
}  // namespace afm::physics
