// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/levelling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include "physics/normal_generator.h"

namespace afm::physics {
namespace levelling_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kColumns = 40, kRows = 25;

// Hills on a plane, from the top row on.
std::vector<double> tilted(double slope_x, double slope_y, double offset) {
  std::vector<double> heights;
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) {
      const auto x = static_cast<double>(column), y = -static_cast<double>(row);
      heights.push_back(1e-9 * std::sin(0.9 * x) * std::cos(0.7 * y) + slope_x * x + slope_y * y + offset);
    }
  }
  return heights;
}

double tilt_of(const std::vector<double>& heights) {
  const LevelledHeights again = levelled(heights, kColumns, kRows, Levelling::Plane);
  return std::hypot(again.slope_x, again.slope_y);
}

TEST(Levelling, TakesOffThePlaneAndKeepsTheMean) {
  const auto raw = tilted(3e-9, -2e-9, 5e-6);
  const LevelledHeights level = levelled(raw, kColumns, kRows, Levelling::Plane);
  const LevelledHeights bare = levelled(tilted(0, 0, 0), kColumns, kRows, Levelling::Plane);
  EXPECT_NEAR(level.slope_x - bare.slope_x, 3e-9, 1e-18);
  EXPECT_NEAR(level.slope_y - bare.slope_y, -2e-9, 1e-18);
  EXPECT_NEAR(height_statistics(level.heights).mean, height_statistics(raw).mean, 1e-18);
  EXPECT_NEAR(height_statistics(level.heights).sq, height_statistics(bare.heights).sq, 1e-18);
  EXPECT_LT(tilt_of(level.heights), 1e-20);
}

TEST(Levelling, OfNothingLeavesTheHeightsAsTheyAre) {
  const auto raw = tilted(3e-9, -2e-9, 5e-6);
  EXPECT_EQ(levelled(raw, kColumns, kRows, Levelling::None).heights, raw);
}

TEST(Levelling, OfLinesUndoesTheStepsBetweenThem) {
  auto raw = tilted(2e-9, 0, 0);
  const auto straight = levelled(raw, kColumns, kRows, Levelling::Lines).heights;
  std::mt19937 random(4);
  std::normal_distribution<double> step(0.0, 20e-9);
  for (std::size_t row = 0; row < kRows; ++row) {
    const double jump = step(random);
    for (std::size_t column = 0; column < kColumns; ++column) raw[row * kColumns + column] += jump;
  }
  // one bright particle shifts no line
  for (std::size_t column = 10; column < 15; ++column) raw[12 * kColumns + column] += 500e-9;
  const auto level = levelled(raw, kColumns, kRows, Levelling::Lines).heights;
  const double shift = level[0] - straight[0];
  double worst = 0;
  for (std::size_t i = 0; i < level.size(); ++i) {
    const bool particle = i / kColumns == 12 && i % kColumns >= 10 && i % kColumns < 15;
    // the particle tilts the plane of least squares a little
    if (!particle) worst = std::max(worst, std::abs(level[i] - straight[i] - shift));
  }
  EXPECT_LT(worst, 6e-9);
  EXPECT_LT(tilt_of(level), 1e-20);
}

TEST(Levelling, PassesOverWhatWasNotMeasuredAndFillsItFromAround) {
  auto raw = tilted(3e-9, 1e-9, 0);
  const LevelledHeights whole = levelled(raw, kColumns, kRows, Levelling::Plane);
  for (std::size_t row = 8; row < 13; ++row) {
    for (std::size_t column = 20; column < 27; ++column) raw[row * kColumns + column] = kNan;
  }
  const LevelledHeights level = levelled(raw, kColumns, kRows, Levelling::Plane);
  EXPECT_EQ(level.filled, 35U);
  EXPECT_NEAR(level.slope_x, whole.slope_x, 0.02 * whole.slope_x);
  const HeightStatistics around = height_statistics(whole.heights);
  for (std::size_t row = 8; row < 13; ++row) {
    for (std::size_t column = 20; column < 27; ++column) {
      const double filled = level.heights[row * kColumns + column];
      EXPECT_GT(filled, around.lowest - 5e-10);
      EXPECT_LT(filled, around.highest + 5e-10);
    }
  }
}

TEST(Levelling, RefusesWhatIsNoTopography) {
  const std::vector<double> nothing(12, kNan), some(12, 1.0);
  EXPECT_THROW(levelled(nothing, 4, 3, Levelling::Plane), std::invalid_argument);
  EXPECT_THROW(levelled(some, 5, 3, Levelling::Plane), std::invalid_argument);
  EXPECT_THROW(levelled({}, 0, 0, Levelling::Plane), std::invalid_argument);
  for (const double absurd : {1e300, -1e300}) {
    std::vector<double> heights(12, kNan);  // whose sums have no value: what is not measured could never be filled
    heights[3] = absurd;
    heights[8] = -absurd;
    for (const Levelling levelling : {Levelling::Lines, Levelling::Plane, Levelling::None}) {
      EXPECT_THROW(levelled(heights, 4, 3, levelling), std::invalid_argument);
    }
  }
  std::vector<double> one(12, kNan);
  one[5] = 7.0;
  EXPECT_EQ(levelled(one, 4, 3, Levelling::Lines).heights, std::vector<double>(12, 7.0));
}

TEST(HeightStatistics, CountWhatWasMeasuredAlone) {
  const std::vector<double> heights{1.0, kNan, 3.0, 5.0, kNan, 7.0};
  const HeightStatistics statistics = height_statistics(heights);
  EXPECT_EQ(statistics.measured, 4U);
  EXPECT_DOUBLE_EQ(statistics.mean, 4.0);
  EXPECT_DOUBLE_EQ(statistics.sq, std::sqrt(5.0));
  EXPECT_EQ(statistics.lowest, 1.0);
  EXPECT_EQ(statistics.highest, 7.0);
  EXPECT_EQ(height_statistics(std::vector<double>{kNan}).measured, 0U);
}

TEST(Levelling, F17FindsTheNoiseOfAFlatSample) {
  constexpr int kRuns = 10;
  constexpr std::size_t kPoints = std::size_t{256} * 256;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    NormalGenerator noise(static_cast<std::uint64_t>(run + 1));
    std::vector<double> heights(kPoints);
    for (double& height : heights) height = 0.1e-9 * noise();
    sum += height_statistics(heights).sq;
  }
  EXPECT_NEAR(sum / kRuns, 1e-10, 0.005 * 1e-10);
}

}  // namespace levelling_test
}  // namespace afm::physics
