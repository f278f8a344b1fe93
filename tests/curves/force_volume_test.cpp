// SPDX-License-Identifier: Apache-2.0
// The curves of a force map as one volume to look at.
#include "curves/force_volume.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <thread>
#include <vector>

namespace afm::curves {
namespace force_volume_test {

using Way = ForceVolume::Way;

constexpr double kPushedM = 50e-9;  // depth of every curve below the contact

// A spring of 1 N/m below its contact, with a pull of 5 nN on the way up to 20 nm above it, on a baseline of 3 nN.
RecordedCurve curve_at(const MapGrid& grid, std::size_t column, std::size_t row, double stiffness = 1.0) {
  constexpr double kTopM = 200e-9, kStepM = 0.25e-9;
  RecordedCurve curve;
  curve.metadata.pixel = MapPixel{grid, column, row};
  const auto add = [&](double z_m, double force_n, physics::Branch branch) {
    curve.points.push_back({physics::Length(1e-6 + z_m), physics::Force(3e-9 + force_n), branch});
  };
  const auto spring_n = [&](double z_m) { return z_m < 0.0 ? -stiffness * z_m : 0.0; };
  for (double z_m = kTopM; z_m > -kPushedM; z_m -= kStepM) add(z_m, spring_n(z_m), physics::Branch::Approach);
  for (double z_m = -kPushedM; z_m < kTopM; z_m += kStepM) {
    add(z_m, spring_n(z_m) - (z_m > -5e-9 && z_m < 20e-9 ? 5e-9 : 0.0), physics::Branch::Retract);
  }
  return curve;
}

const MapGrid kGrid{.columns = 4, .rows = 3, .width_m = 4e-6, .height_m = 3e-6};

ForceVolume volume_of(const MapGrid& grid) {
  ForceVolume::Gatherer gatherer;
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      if (column == 3 && row == 2) continue;
      gatherer.add(curve_at(grid, column, row, 1.0 + static_cast<double>(column)));
    }
  }
  return gatherer.finish();
}

TEST(ForceVolume, HasTheForcesOfItsCurvesAboveTheirDeepestPoints) {
  const ForceVolume volume = volume_of(kGrid);
  EXPECT_EQ(volume.size(), 12U);
  EXPECT_EQ(volume.known(), 11U);
  // 30 nm above the deepest point, 20 nm below the contact
  EXPECT_NEAR(volume.force_n(Way::Approach, 0.1, 0.1, 30e-9), 20e-9, 1.5e-9);
  EXPECT_NEAR(volume.force_n(Way::Approach, 0.9, 0.1, 30e-9), 80e-9, 5e-9) << "a stiffer pixel at the right";
  EXPECT_NEAR(volume.force_n(Way::Approach, 0.1, 0.1, 65e-9), 0.0, 0.2e-9) << "without the baseline";
  EXPECT_NEAR(volume.force_n(Way::Retract, 0.1, 0.1, 65e-9), -5e-9, 0.5e-9);
  EXPECT_TRUE(std::isnan(volume.force_n(Way::Approach, 0.9, 0.9, 30e-9))) << "no curve there";
  EXPECT_TRUE(std::isnan(volume.force_n(Way::Approach, 0.1, 0.1, 1e-6))) << "higher than the curve";
  EXPECT_LT(volume.strongest_pull_n(), -4e-9);
  EXPECT_GT(volume.strongest_push_n(), 120e-9);
  EXPECT_GT(volume.top_m(), 65e-9) << "what pulls is shown";
  EXPECT_LT(volume.top_m(), 110e-9) << "where nothing acts is not";
}

TEST(ForceVolume, FindsWhereAForceIsReached) {
  const ForceVolume volume = volume_of(kGrid);
  EXPECT_NEAR(volume.height_of_m(20e-9, 0.1, 0.1), 30e-9, 1.5e-9);
  EXPECT_NEAR(volume.height_of_m(20e-9, 0.9, 0.1), 45e-9, 1.5e-9) << "a stiffer pixel reaches it higher";
  EXPECT_NEAR(volume.height_of_m(-3e-9, 0.1, 0.1), 70e-9, 2e-9) << "a pull, on the way up";
  EXPECT_TRUE(std::isnan(volume.height_of_m(1e-6, 0.1, 0.1)));
  EXPECT_EQ(volume.reached(20e-9), 11U);
  EXPECT_EQ(volume.reached(120e-9), 5U) << "two columns and a hole";
  EXPECT_EQ(volume.reached(-3e-9), 11U);
  EXPECT_TRUE(std::isnan(volume.height_of_m(20e-9, 0.9, 0.9)));
}

TEST(ForceVolume, ThinsALargeMapAndKeepsItsPlaces) {
  const MapGrid grid{.columns = 300, .rows = 2, .width_m = 300e-6, .height_m = 2e-6};
  ForceVolume::Gatherer gatherer;
  std::vector<std::jthread> threads;
  for (std::size_t part = 0; part < 2; ++part) {
    threads.emplace_back([&, part] {
      for (std::size_t column = part; column < grid.columns; column += 2) {
        gatherer.add(curve_at(grid, column, 0, column < 150 ? 1.0 : 4.0));
      }
    });
  }
  threads.clear();
  const ForceVolume volume = gatherer.finish();
  EXPECT_EQ(volume.size(), 100U);
  EXPECT_EQ(volume.known(), 100U);
  EXPECT_NEAR(volume.force_n(Way::Approach, 0.25, 0.0, 30e-9), 20e-9, 1.5e-9);
  EXPECT_NEAR(volume.force_n(Way::Approach, 0.75, 0.0, 30e-9), 80e-9, 5e-9);
}

TEST(ForceVolume, IsEmptyWithoutACurveThatTouches) {
  ForceVolume::Gatherer gatherer;
  RecordedCurve flat = curve_at(kGrid, 0, 0, 0.0);
  for (auto& point : flat.points) point.force = physics::Force();
  gatherer.add(flat);
  gatherer.add(RecordedCurve{});
  const ForceVolume volume = gatherer.finish();
  EXPECT_EQ(volume.known(), 0U);
  EXPECT_TRUE(std::isnan(volume.force_n(Way::Approach, 0.5, 0.5, 0.0)));
  EXPECT_TRUE(std::isnan(volume.height_of_m(1e-9, 0.5, 0.5)));
}

}  // namespace force_volume_test
}  // namespace afm::curves
