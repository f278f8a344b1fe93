// SPDX-License-Identifier: Apache-2.0
#include "gram.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "correlated_noise.h"

namespace afm::fits {
namespace gram_test {

constexpr std::size_t kCount = 41, kLate = 18, kUnknowns = 4, kLevelPlace = 2;

// Residuals, two columns that begin late, a tilt, and the level's, which Gram does not ask for.
struct Curve {
  std::array<std::vector<double>, kUnknowns + 1> columns;  // columns by unknown, the residuals last

  explicit Curve(unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> value;
    for (std::vector<double>& column : columns) {
      for (std::size_t t = 0; t < kCount; ++t) column.push_back(value(random));
    }
    for (const std::size_t late : {0U, 1U}) std::fill_n(columns[late].begin(), kLate, 0.0);
    columns[kLevelPlace].assign(kCount, 1.0);
  }

  Gram gram(std::span<const double> noise) const {
    Columns asked;
    for (const std::size_t unknown : {4U, 3U, 0U, 1U}) {
      asked.values[asked.count] = columns[unknown].data();
      asked.unknowns[asked.count++] = unknown;
    }
    asked.dense = 2;
    asked.late = kLate;
    asked.size = kCount;
    asked.level = kLevelPlace;
    return {asked, noise};
  }

  std::vector<double> whitened(std::size_t column, std::span<const double> noise) const {
    std::vector<double> values(columns[column]);
    values.resize(whiten(noise, values));
    return values;
  }
  double product(std::size_t a, std::size_t b, std::span<const double> noise) const {
    const std::vector<double> one = whitened(a, noise), other = whitened(b, noise);
    double sum = 0.0;
    for (std::size_t t = 0; t < one.size(); ++t) sum += one[t] * other[t];
    return sum;
  }
};

const std::array<std::vector<double>, 4> kNoises{std::vector<double>{}, {0.9}, {0.7, -0.2}, {0.5, 0.1, -0.2, 0.3}};

TEST(Gram, HasTheSumsOfTheWhitenedColumns) {
  const Curve curve(1);
  for (const std::vector<double>& noise : kNoises) {
    const Gram gram = curve.gram(noise);
    EXPECT_NEAR(gram.squares(), curve.product(kUnknowns, kUnknowns, noise), 1e-10);
    const Gram::Few few = gram.few({});
    ASSERT_EQ(few.columns, kUnknowns);
    const std::size_t rows = kUnknowns + 1;
    for (std::size_t a = 0; a < kUnknowns; ++a) {
      double gradient = 0.0;
      for (std::size_t row = 0; row < rows; ++row) gradient += few.jacobian[a * rows + row] * few.residuals[row];
      EXPECT_NEAR(gradient, curve.product(a, kUnknowns, noise), 1e-10) << a << " of order " << noise.size();
      for (std::size_t b = 0; b < kUnknowns; ++b) {
        double product = 0.0;
        for (std::size_t row = 0; row < rows; ++row) {
          product += few.jacobian[a * rows + row] * few.jacobian[b * rows + row];
        }
        EXPECT_NEAR(product, curve.product(a, b, noise), 1e-10) << a << ", " << b << " of order " << noise.size();
      }
    }
  }
}

TEST(Gram, LeavesOutTheUnknownThatIsHeld) {
  const Curve curve(2);
  const Gram::Few few = curve.gram(kNoises[1]).few(1);
  ASSERT_EQ(few.columns, kUnknowns - 1);
  double squares = 0.0;
  for (std::size_t row = 0; row < kUnknowns; ++row) squares += few.jacobian[row] * few.jacobian[row];
  EXPECT_NEAR(squares, curve.product(0, 0, kNoises[1]), 1e-10);
}

// For a linear problem the step leads exactly to the minimum, and no change of the others leads lower.
TEST(Gram, StepsToASumOfSquares) {
  const Curve curve(3);
  for (const std::vector<double>& noise : kNoises) {
    const Gram gram = curve.gram(noise);
    const double squares = 1.2 * gram.squares();
    for (const double side : {-1.0, 1.0}) {
      const auto step = gram.step_to(squares, 0, side);
      ASSERT_TRUE(step);
      EXPECT_GT(side * (*step)[0], 0.0);
      Curve there(curve);
      for (std::size_t unknown = 0; unknown < kUnknowns; ++unknown) {
        for (std::size_t t = 0; t < kCount; ++t) {
          there.columns[kUnknowns][t] += (*step)[unknown] * curve.columns[unknown][t];
        }
      }
      const Gram moved = there.gram(noise);
      EXPECT_NEAR(moved.squares(), squares, 1e-9 * squares);
      for (const std::size_t other : {1U, 2U, 3U}) EXPECT_NEAR(moved.gradient(other), 0.0, 1e-9);
    }
    EXPECT_FALSE(gram.step_to(1e-3 * gram.squares(), 0, 1.0)) << "less than the least";
  }
}

TEST(Gram, OfColumnsThatDependOnEachOtherHasNoStep) {
  Curve curve(4);
  for (std::size_t t = 0; t < kCount; ++t) curve.columns[1][t] = 2.0 * curve.columns[0][t];
  const Gram gram = curve.gram({});
  EXPECT_EQ(gram.own(0), 0.0);
  EXPECT_GT(gram.few({}).jacobian[0], 0.0);
  EXPECT_FALSE(gram.step_to(2.0 * gram.squares(), 0, 1.0));
  // the square that the column of a straight line leaves of a constant one
  EXPECT_LT(Curve(4).gram({}).own(kLevelPlace), static_cast<double>(kCount));
}

}  // namespace gram_test
}  // namespace afm::fits
