// SPDX-License-Identifier: Apache-2.0
#include "fits/interval.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "fits/elastic_fit.h"

namespace afm::fits {
namespace interval_test {

// A fit that leaves the interval out, for a benchmark, finds the same modulus.
TEST(IntervalOfAFit, IsLeftOutIfItIsNotWanted) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 15e-12);
  std::vector<Sample> samples;
  for (int i = 0; i < 600; ++i) {
    const double depth_m = 5e-9 * (i - 400);
    const double force_n = depth_m > 0.0 ? 4.0 / 3.0 * 4e3 * std::sqrt(5e-6) * std::pow(depth_m, 1.5) : 0.0;
    samples.push_back({-depth_m - force_n / 0.05, force_n + noise(random)});
  }
  FitSetup setup;
  setup.indenter = {.shape = Shape::Paraboloid, .radius_m = 5e-6, .table = {}};
  setup.spring_n_per_m = 0.05;
  std::string why;
  const auto with = fit(samples, setup, why);
  setup.interval = false;
  const auto without = fit(samples, setup, why);
  ASSERT_TRUE(with && without) << why;
  EXPECT_EQ(without->modulus_pa, with->modulus_pa);
  EXPECT_NEAR(with->reduced_modulus_pa, 4e3, 40.0);
  EXPECT_LT(with->modulus_interval_pa.high, 1.1 * with->modulus_pa);
  EXPECT_EQ(without->modulus_interval_pa.low, 0.0);
  EXPECT_EQ(without->modulus_interval_pa.high, std::numeric_limits<double>::infinity());
}

}  // namespace interval_test
}  // namespace afm::fits
