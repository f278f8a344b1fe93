// SPDX-License-Identifier: Apache-2.0
#include "drawing/distance_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace afm::test {
namespace distance_order_test {

std::vector<std::uint32_t> sorted(render::DistanceOrder& order, const std::vector<double>& distances) {
  order.clear();
  for (std::uint32_t i = 0; i < distances.size(); ++i) order.add(distances[i], i);
  std::vector<std::uint32_t> draws;
  order.near_to_far(draws);
  return draws;
}

// Few draws and many, with distances from the size of an atom to that of a city, many of them equal.
TEST(DistanceOrder, IsThatOfTheDistancesAndThenOfTheDraws) {
  std::mt19937 random(2026);
  std::uniform_real_distribution<double> exponent(-10.0, 5.0);
  render::DistanceOrder order;
  for (const std::size_t count : {0U, 1U, 2U, 127U, 128U, 20'000U, 30U}) {
    std::vector<double> distances(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double chosen = exponent(random);
      distances[i] = i % 3 == 0 ? std::floor(chosen + 10.0) : std::pow(10.0, chosen);
    }
    std::vector<std::uint32_t> expected(count);
    for (std::uint32_t i = 0; i < count; ++i) expected[i] = i;
    std::stable_sort(expected.begin(), expected.end(), [&](std::uint32_t a, std::uint32_t b) {
      return static_cast<float>(distances[a]) < static_cast<float>(distances[b]);
    });
    EXPECT_EQ(sorted(order, distances), expected) << count;
  }
}

TEST(DistanceOrder, BeginsWithWhatIsAtTheEye) {
  render::DistanceOrder order;
  EXPECT_EQ(sorted(order, {1.0, -0.0, 0.5, 0.0}), (std::vector<std::uint32_t>{1, 3, 2, 0}));
}

}  // namespace distance_order_test
}  // namespace afm::test
