// SPDX-License-Identifier: Apache-2.0
// The baseline that a user chooses: its shape, and the part of the approach that it is fitted to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <stdexcept>
#include <vector>

#include "gel_curve.h"
#include "physics/curve_analysis.h"

namespace baseline_test {

using namespace afm::physics;
using namespace afm::test;

constexpr double kLevelN = 1e-9;

CurveFeatures analysed(const Gel& gel, const BaselineChoice& choice, std::uint64_t seed = 7) {
  std::mt19937_64 random(seed);
  return analyse(gel_cycle(gel, random), ForceZero::Instrument, std::nullopt, choice);
}

double error_of_contact_m(const CurveFeatures& features) {
  return features.contact_point ? std::abs(features.contact_point->si - kContactM) : HUGE_VAL;
}

TEST(ChosenBaseline, WithWavesFindsPeriodAndAmplitude) {
  for (const double period_m : {150e-9, 400e-9, 900e-9}) {
    const Gel gel{.outside_m = 3e-6, .tilt = 2e-5, .wave_n = 100e-12, .period_m = period_m, .phase = 1.0};
    const Baseline baseline = analysed(gel, {.shape = BaselineShape::Waves}).baseline;
    EXPECT_NEAR(baseline.waves.period.si, period_m, 0.005 * period_m);
    EXPECT_NEAR(baseline.waves.amplitude().si, gel.wave_n, 2e-12);
    EXPECT_NEAR(baseline.tilt.si, gel.tilt, 2e-6);
    EXPECT_NEAR(baseline.noise.si, kNoiseN, 1e-12);
    const double recorded_n =
        kLevelN + gel.tilt * 1e-6 + gel.wave_n * std::sin(2.0 * std::numbers::pi * 1e-6 / period_m + 1.0);
    EXPECT_NEAR(baseline.at(Length(kContactM + 1e-6)).si, recorded_n, 3e-12);
  }
}

TEST(ChosenBaseline, WithWavesBringsTheContactPointBack) {
  std::mt19937_64 random(3);
  std::vector<double> with_m, without_m;
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Gel gel{.modulus_pa = 2e3,
                  .depth_m = 800e-9,
                  .outside_m = 2.5e-6,
                  .wave_n = 60e-12,
                  .period_m = std::uniform_real_distribution(250e-9, 700e-9)(random),
                  .phase = std::uniform_real_distribution(0.0, 6.28)(random)};
    with_m.push_back(error_of_contact_m(analysed(gel, {.shape = BaselineShape::Waves}, 100 + i)));
    without_m.push_back(error_of_contact_m(analysed(gel, {}, 100 + i)));
  }
  std::sort(with_m.begin(), with_m.end());
  std::sort(without_m.begin(), without_m.end());
  EXPECT_LT(with_m[10], 5e-9);
  EXPECT_LT(with_m[10], 0.5 * without_m[10]);
}

TEST(ChosenBaseline, HasNoWavesWhereThereAreNone) {
  const CurveFeatures features = analysed({.tilt = 1e-4}, {.shape = BaselineShape::Waves});
  EXPECT_EQ(features.baseline.waves.period.si, 0.0);
  EXPECT_EQ(features.baseline.waves.at(Length(1e-7)).si, 0.0);
  EXPECT_NEAR(features.baseline.tilt.si, 1e-4, 1e-6);
}

TEST(ChosenBaseline, IsFlatWhereItIsAskedFor) {
  const Baseline flat = analysed({.tilt = 1e-5}, {.shape = BaselineShape::Flat}).baseline;
  EXPECT_EQ(flat.tilt.si, 0.0);
  EXPECT_NEAR(flat.level.si, kLevelN, 50e-12);
}

// The outermost micrometre is bent, as after an approach by the motor.
TEST(ChosenBaseline, LiesInTheRangeThatIsAskedFor) {
  std::mt19937_64 random(5);
  std::vector<CurvePoint> points = gel_cycle({.outside_m = 3e-6}, random);
  for (CurvePoint& point : points) {
    const double beyond_m = point.z.si - (kContactM + 2e-6);
    if (beyond_m > 0.0) point.force.si += 1e-3 * beyond_m * beyond_m / 1e-6;
  }
  const auto level_of = [&](const BaselineChoice& choice) {
    return analyse(points, ForceZero::Instrument, std::nullopt, choice).baseline.at(Length(kContactM)).si;
  };
  EXPECT_GT(std::abs(level_of({}) - kLevelN), 100e-12) << "the bend would not matter";
  const WayRange inner{Length(1e-6), Length(2.8e-6)};
  EXPECT_NEAR(level_of({.shape = BaselineShape::Tilted, .range = inner}), kLevelN, 3e-12);
  EXPECT_NEAR(level_of({.shape = BaselineShape::Flat, .range = inner}), kLevelN, 3e-12);
}

TEST(ChosenBaseline, RefusesARangeWithoutPoints) {
  EXPECT_THROW(analysed({}, {.shape = BaselineShape::Tilted, .range = WayRange{Length(9e-6), Length(10e-6)}}),
               std::invalid_argument);
  EXPECT_NO_THROW(analysed({}, {.shape = BaselineShape::Tilted, .range = WayRange{Length(0.0), Length(0.5e-6)}}));
}

// The median is that of the sorted forces, in whichever order they come: rising, falling, as a roof, in a few digits,
// all the same, or at random.
TEST(ChosenBaseline, HasTheMedianOfForcesInAnyOrder) {
  constexpr int kCount = 3001;
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> digits(0, 4);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<std::vector<double>> orders(6);
  for (int i = 0; i < kCount; ++i) {
    orders[0].push_back(i);
    orders[1].push_back(-i);
    orders[2].push_back(std::min(i, kCount - i));
    orders[3].push_back(digits(random));
    orders[4].push_back(7.0);
    orders[5].push_back(any(random));
  }
  for (const int left_out : {0, 1}) {
    for (std::size_t order = 0; order < orders.size(); ++order) {
      std::vector<double> forces(orders[order]);
      forces.resize(static_cast<std::size_t>(kCount - left_out));
      std::vector<CurvePoint> points;
      for (std::size_t i = 0; i < forces.size(); ++i) {
        points.push_back({Length(-1e-9 * static_cast<double>(i)), Force(forces[i]), Branch::Approach});
      }
      const BaselineChoice flat{.shape = BaselineShape::Flat, .range = WayRange{Length(0.0), Length(1e-3)}};
      const Baseline found = analyse(points, ForceZero::Instrument, std::nullopt, flat).baseline;
      std::sort(forces.begin(), forces.end());
      const std::size_t middle = forces.size() / 2;
      const double median = forces.size() % 2 == 1 ? forces[middle] : 0.5 * (forces[middle] + forces[middle - 1]);
      EXPECT_EQ(found.level.si, median) << order << ", " << forces.size();
    }
  }
}

}  // namespace baseline_test
