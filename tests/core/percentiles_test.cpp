// SPDX-License-Identifier: Apache-2.0
#include "core/percentiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace afm::core {
namespace percentiles_test {

// p of the values are at most as large, and no smaller value will do.
TEST(Percentiles, AreTheSmallestValuesThatCoverTheirShare) {
  std::vector<double> thousand(1000);
  std::iota(thousand.begin(), thousand.end(), 1.0);
  std::shuffle(thousand.begin(), thousand.end(), std::mt19937(1));
  const Percentiles of = percentiles(thousand);
  EXPECT_EQ(of.p50, 500);
  EXPECT_EQ(of.p99, 990);
  EXPECT_EQ(of.p999, 999);
  EXPECT_EQ(of.max, 1000);
}

TEST(Percentiles, OfFewValuesAreTheLargest) {
  for (const std::vector<double>& values : {std::vector{7.0}, std::vector{7.0, 3.0}, std::vector{1.0, 7.0, 3.0}}) {
    const Percentiles of = percentiles(values);
    EXPECT_EQ(of.p99, 7.0) << values.size();
    EXPECT_EQ(of.p999, 7.0) << values.size();
    EXPECT_EQ(of.max, 7.0) << values.size();
  }
  EXPECT_EQ(percentiles(std::vector{7.0, 3.0}).p50, 3.0);
  EXPECT_EQ(percentiles(std::vector{1.0, 7.0, 3.0}).p50, 3.0);
}

TEST(Percentiles, OfNothingAreZero) {
  EXPECT_EQ(percentiles(std::vector<double>()).max, 0.0);
  EXPECT_EQ(percentiles(std::array<std::uint32_t, 3>{}, 9).max, 0.0);
}

TEST(Percentiles, OfAHistogramAreUpperEdgesOfBins) {
  std::array<std::uint32_t, 5> bins{};
  bins[0] = 50;  // latencies up to 1 us
  bins[1] = 49;
  bins[3] = 1;
  const Percentiles of = percentiles(bins, 4);
  EXPECT_EQ(of.p50, 1);
  EXPECT_EQ(of.p99, 2);
  EXPECT_EQ(of.p999, 4);
  EXPECT_EQ(of.max, 4);
}

// The last bin holds all that is longer.
TEST(Percentiles, BeyondAHistogramAreItsMaximum) {
  const std::array<std::uint32_t, 3> bins{1, 0, 99};
  const Percentiles of = percentiles(bins, 700);
  EXPECT_EQ(of.p50, 700);
  EXPECT_EQ(of.max, 700);
}

TEST(Percentiles, OfAHistogramAreNeverAboveItsMaximum) {
  std::array<std::uint32_t, 401> bins{};
  bins[42] = 998;
  bins[357] = 2;  // 357.3 and 357.9 us: the maximum is kept in whole microseconds
  const Percentiles of = percentiles(bins, 357);
  EXPECT_EQ(of.p50, 43.0);
  EXPECT_EQ(of.p999, 357.0);
  EXPECT_EQ(of.max, 357.0);
}

}  // namespace percentiles_test
}  // namespace afm::core
