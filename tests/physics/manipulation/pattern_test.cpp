// SPDX-License-Identifier: Apache-2.0
// Invariant: the distance from a pattern is the least over every assignment of particles to its targets
#include "physics/manipulation/pattern.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace afm::physics {
namespace pattern_test {

using Places = std::vector<Sideways<Length>>;

Sideways<Length> at_nm(double x, double y) { return {Length(1e-9 * x), Length(1e-9 * y)}; }

// Least distance, found by trying every order of the particles.
double least_rms_m(const Places& targets, const Places& particles) {
  std::vector<std::size_t> order(particles.size());
  std::iota(order.begin(), order.end(), 0U);
  double least_m2 = std::numeric_limits<double>::infinity();
  do {
    double sum_m2 = 0.0;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const double apart_m = magnitude(targets[i] - particles[order[i]]).si;
      sum_m2 += apart_m * apart_m;
    }
    least_m2 = std::min(least_m2, sum_m2);
  } while (std::next_permutation(order.begin(), order.end()));
  return std::sqrt(least_m2 / static_cast<double>(targets.size()));
}

TEST(Pattern, IsMatchedByTheAssignmentWithTheLeastSquares) {
  std::mt19937_64 random(36);
  std::uniform_real_distribution<double> place(-500.0, 500.0);
  for (int round = 0; round < 300; ++round) {
    const std::size_t particles = 1 + random() % 7, targets = 1 + random() % particles;
    const auto anywhere = [&] {
      const double x_nm = place(random);
      return at_nm(x_nm, place(random));
    };
    Places wanted, there;
    for (std::size_t i = 0; i < targets; ++i) wanted.push_back(anywhere());
    for (std::size_t i = 0; i < particles; ++i) there.push_back(anywhere());
    const PatternMatch match = match_pattern(wanted, there);
    ASSERT_NEAR(match.rms.si, least_rms_m(wanted, there), 1e-9 * match.rms.si) << round;
    const std::set<std::size_t> each(match.particles.begin(), match.particles.end());
    ASSERT_EQ(each.size(), targets) << "one particle is on one target alone";
    ASSERT_LT(*each.rbegin(), particles);
  }
}

// Two that are nearest to the same target: the one that loses least goes elsewhere.
TEST(Pattern, LeavesTheNearestToWhomItHelpsMost) {
  const Places targets{at_nm(0, 0), at_nm(100, 0)}, particles{at_nm(10, 0), at_nm(-30, 0)};
  const PatternMatch match = match_pattern(targets, particles);
  EXPECT_EQ(match.particles, (std::vector<std::size_t>{1, 0}));
  EXPECT_NEAR(match.rms.si, 1e-9 * std::sqrt((30.0 * 30.0 + 90.0 * 90.0) / 2.0), 1e-20);
}

TEST(Pattern, IsZeroWhenDoneAndWithoutTargets) {
  const Places there{at_nm(5, 5), at_nm(70, -20), at_nm(0, 300)};
  EXPECT_EQ(match_pattern(there, there).rms.si, 0.0);
  EXPECT_EQ(match_pattern({}, there).rms.si, 0.0);
  EXPECT_TRUE(match_pattern({}, {}).particles.empty());
}

}  // namespace pattern_test
}  // namespace afm::physics
