// SPDX-License-Identifier: Apache-2.0
// A tip is round up to its radius only. Depths beyond it are those of a sharp tip, or of heights in a wrong unit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "fits/elastic_fit.h"

namespace afm::fits {
namespace depth_doubt_test {

bool is_doubted(const ElasticFit& fit) {
  return std::any_of(fit.doubts.begin(), fit.doubts.end(),
                     [](const Found& found) { return found.doubt == Doubt::BeyondTip; });
}

// A paraboloid of this radius pressed 2 um deep, with 1 pN of noise.
ElasticFit fit_with(double radius_m, const Indenter& tip) {
  constexpr std::size_t kCount = 400;
  constexpr double kSpring = 0.05, kReduced = 2e3, kDeepest = 2e-6;
  const Indenter true_tip{.shape = Shape::Paraboloid, .radius_m = radius_m};
  std::mt19937_64 random(1);
  std::normal_distribution<double> noise(0.0, 1e-12);
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < kCount; ++i) {
    const double depth = kDeepest * (2.0 * static_cast<double>(i) / (kCount - 1) - 1.0);
    const double force = kReduced * push_of(true_tip, depth).force;
    samples.push_back({.z_m = -depth - force / kSpring, .force_n = force + noise(random)});
  }
  FitSetup setup;
  setup.indenter = tip;
  setup.spring_n_per_m = kSpring;
  setup.starts = {0.0};
  std::string why;
  const auto found = fit(samples, setup, why);
  EXPECT_TRUE(found) << why;
  return found.value_or(ElasticFit{});
}

TEST(DepthOfAFit, BeyondTheRadiusIsDoubtful) {
  for (const Shape shape : {Shape::Paraboloid, Shape::Sphere}) {
    EXPECT_FALSE(is_doubted(fit_with(2.2e-6, {.shape = shape, .radius_m = 2.2e-6})));
    const ElasticFit deep = fit_with(1.8e-6, {.shape = shape, .radius_m = 1.8e-6});
    EXPECT_TRUE(is_doubted(deep));
    EXPECT_EQ(deep.trust, Trust::Doubtful);
  }
  EXPECT_FALSE(is_doubted(fit_with(1e-6, {.shape = Shape::Cone, .half_angle_rad = 0.4}))) << "a cone has no radius";
}

}  // namespace depth_doubt_test
}  // namespace afm::fits
