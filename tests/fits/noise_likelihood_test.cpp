// SPDX-License-Identifier: Apache-2.0
#include "noise_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace afm::fits {
namespace noise_likelihood_test {

constexpr std::size_t kCount = 60;

// Residuals and the columns of a level, a ramp and a push that begins late.
struct Fit {
  std::vector<double> residuals, jacobian;

  Fit() {
    std::mt19937_64 random(5);
    std::normal_distribution<double> white;
    double slow = 0.0;
    for (std::size_t t = 0; t < kCount; ++t) {
      const double value = white(random);
      slow = 0.6 * slow + value;
      residuals.push_back(slow);
    }
    for (std::size_t t = 0; t < kCount; ++t) jacobian.push_back(1.0);
    for (std::size_t t = 0; t < kCount; ++t) jacobian.push_back(static_cast<double>(t));
    for (std::size_t t = 0; t < kCount; ++t)
      jacobian.push_back(t < 30 ? 0.0 : std::pow(static_cast<double>(t) - 29.0, 1.5));
  }
};

TEST(LaggedProducts, AreTheSumsOverTheCurve) {
  const Fit fit;
  const std::vector<double> level(fit.jacobian.begin(), fit.jacobian.begin() + kCount);  // largest value 1
  const LaggedProducts products(fit.residuals, level);
  ASSERT_EQ(products.columns(), 2U);
  for (std::size_t i = 0; i < kLags; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double own = 0.0, shared = 0.0;
      for (std::size_t t = kMostNoiseOrder; t < kCount; ++t) {
        own += fit.residuals[t - i] * fit.residuals[t - j];
        shared += fit.residuals[t - i] + (i == j ? 0.0 : fit.residuals[t - j]);
      }
      const double both = i == j ? 1.0 : 2.0;
      EXPECT_NEAR(products.of(i, j)[0], both * own, 1e-10) << i << ", " << j;
      EXPECT_NEAR(products.of(j, i)[1], shared, 1e-10) << i << ", " << j;
      EXPECT_NEAR(products.of(i, j)[2], both * static_cast<double>(kCount - kMostNoiseOrder), 1e-10);
    }
  }
}

TEST(NoiseLikelihood, HasTheSlopesOfCentralDifferences) {
  constexpr double kStep = 1e-4;
  const Fit fit;
  const LaggedProducts products(fit.residuals, fit.jacobian);
  const Orders here{0.5, -0.2, 0.15, 0.1};
  for (std::size_t order = 1; order <= kMostNoiseOrder; ++order) {
    const Deviance found = deviance_with_slopes(products, here, order);
    EXPECT_NEAR(found.value, deviance(products, here, order), 1e-9);
    for (std::size_t l = 0; l < order; ++l) {
      Orders more(here), less(here);
      more[l] += kStep;
      less[l] -= kStep;
      const Deviance above = deviance_with_slopes(products, more, order),
                     below = deviance_with_slopes(products, less, order);
      EXPECT_NEAR(found.gradient[l], (above.value - below.value) / (2.0 * kStep), 1e-5) << l << " of " << order;
      for (std::size_t m = 0; m < order; ++m) {
        EXPECT_NEAR(found.curvature[l][m], (above.gradient[m] - below.gradient[m]) / (2.0 * kStep), 1e-3)
            << l << ", " << m << " of " << order;
      }
    }
  }
}

// Whatever the noise, also where the best process is hardly stationary and the steps do not end.
TEST(NoiseLikelihood, IsLeastAtTheCoefficientsThatAreFound) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> white;
    Fit fit;
    const double share = 0.05 * static_cast<double>(seed % 20);
    double slow = 0.0;
    for (double& residual : fit.residuals) {
      const double value = white(random);
      slow = share * slow + value;
      residual = slow;
    }
    const std::vector<double> found = noise_coefficients(fit.residuals, fit.jacobian);
    if (found.empty()) continue;
    const LaggedProducts products(fit.residuals, fit.jacobian);
    Orders best{};
    for (std::size_t j = 0; j < found.size(); ++j) best[j] = found[j];
    const double least = deviance(products, best, found.size());
    for (std::size_t j = 0; j < found.size(); ++j) {
      // towards fewer correlations, so that the process stays stationary
      Orders other(best);
      other[j] -= std::copysign(0.01, best[j]);
      EXPECT_LT(least, deviance(products, other, found.size()) + 1e-3) << "seed " << seed << ", " << j;
    }
  }
}

}  // namespace noise_likelihood_test
}  // namespace afm::fits
