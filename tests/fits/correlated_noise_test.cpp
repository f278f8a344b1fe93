// SPDX-License-Identifier: Apache-2.0
#include "correlated_noise.h"

#include <gtest/gtest.h>

#include <random>
#include <span>
#include <vector>

namespace afm::fits {
namespace correlated_noise_test {

// Residuals of a fitted straight line, and its columns.
struct Line {
  std::vector<double> residuals, jacobian;
};

Line fitted(const std::vector<double>& coefficients, std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> white;
  std::vector<double> noise;
  constexpr std::size_t kSettling = 200;
  for (std::size_t t = 0; t < count + kSettling; ++t) {
    double value = white(random);
    for (std::size_t j = 0; j < coefficients.size() && j < t; ++j) value += coefficients[j] * noise[t - 1 - j];
    noise.push_back(value);
  }
  noise.erase(noise.begin(), noise.begin() + kSettling);
  Line line;
  line.jacobian.assign(2 * count, 1.0);
  double mean = 0.0, slope = 0.0, squares = 0.0;
  for (std::size_t t = 0; t < count; ++t) {
    const double x = static_cast<double>(t) - 0.5 * static_cast<double>(count - 1);
    line.jacobian[count + t] = x;
    mean += noise[t] / static_cast<double>(count);
    slope += x * noise[t];
    squares += x * x;
  }
  for (std::size_t t = 0; t < count; ++t) {
    line.residuals.push_back(noise[t] - mean - slope / squares * line.jacobian[count + t]);
  }
  return line;
}

// Noise in the mean of many short records.
TEST(CorrelatedNoise, IsFoundAsItWasMadeInSpiteOfTheFit) {
  double first = 0.0;
  constexpr int kRecords = 40;
  for (unsigned seed = 0; seed < kRecords; ++seed) {
    const Line line = fitted({0.9}, 120, seed);
    const auto found = noise_coefficients(line.residuals, line.jacobian);
    double sum = 0.0;  // sum that includes slow errors, whatever the order
    for (const double one : found) sum += one;
    first += sum / kRecords;
  }
  EXPECT_NEAR(first, 0.9, 0.05);
}

TEST(CorrelatedNoise, OfTwoOrdersIsFound) {
  const Line line = fitted({1.4, -0.6}, 4000, 7);
  const auto found = noise_coefficients(line.residuals, line.jacobian);
  ASSERT_GE(found.size(), 2U);
  EXPECT_NEAR(found[0], 1.4, 0.05);
  EXPECT_NEAR(found[1], -0.6, 0.05);
}

TEST(CorrelatedNoise, IsWhiteAfterItsFilter) {
  Line line = fitted({0.9}, 2000, 3);
  EXPECT_LT(runs_probability(line.residuals), 1e-6);
  const auto found = noise_coefficients(line.residuals, line.jacobian);
  const std::size_t left = whiten(found, line.residuals);
  EXPECT_EQ(left, 2000 - found.size());
  EXPECT_GT(runs_probability(std::span(line.residuals).first(left)), 0.01);
}

TEST(CorrelatedNoise, OfAFewPointsIsWhite) {
  const Line line = fitted({0.9}, 12, 1);
  EXPECT_TRUE(noise_coefficients(line.residuals, line.jacobian).empty());
  EXPECT_EQ(runs_probability(std::vector<double>{}), 1.0);
}

}  // namespace correlated_noise_test
}  // namespace afm::fits
