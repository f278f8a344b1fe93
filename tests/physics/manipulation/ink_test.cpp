// SPDX-License-Identifier: Apache-2.0
// Dots and lines of a tip with ink: the table of cases, and the squares that it covers.
#include "physics/manipulation/ink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include "scratching.h"

namespace afm::physics {
namespace ink_test {

using test::expect_relative;

constexpr double kClosed = 1e-6;  // relative tolerance of the table
const Ink kThiol{.molecules_per_s = 1e5, .footprint = Area(0.216e-18)};

// Over 1000 x 600 nm, in squares of 2 nm.
InkedSurface gold() {
  return {kThiol, {Length(-500e-9), Length(-300e-9)}, {Length(500e-9), Length(300e-9)}, Length(300e-9), Length(2e-9)};
}

TEST(Ink, N67DotsAndLines) {
  expect_relative(ink_dot_radius(kThiol, Time(1.0)).si, 8.291859587e-08, kClosed);
  expect_relative(ink_dot_radius(kThiol, Time(10.0)).si, 2.622116233e-07, kClosed);
  expect_relative(ink_line_width(kThiol, Velocity(100e-9)).si, 2.16e-07, kClosed);
}

TEST(Ink, AStandingTipMakesTheRoundDotOfTheFormula) {
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    InkedSurface surface = gold();
    const Time tick(1.0 / rate_hz);
    for (int i = 0; i < static_cast<int>(2.0 * rate_hz); ++i) surface.touch({Length(0.0), Length(0.0)}, tick);
    const Area square = surface.spacing() * surface.spacing();
    EXPECT_NEAR(surface.covered().si, inked_area(kThiol, Time(2.0)).si, 1.01 * square.si) << rate_hz;
    const double diameter_m = 2.0 * ink_dot_radius(kThiol, Time(2.0)).si;
    const std::vector<Sideways<Length>> ends{
        {Length(1e-9), Length(0.0)}, {Length(0.0), Length(1e-9)}, {Length(1e-9), Length(1e-9)}};
    for (const Sideways<Length>& end : ends) {
      EXPECT_NEAR(surface.width({-1.0 * end.x, -1.0 * end.y}, end).si, diameter_m, 3.0 * surface.spacing().si);
    }
  }
}

TEST(Ink, AMovingTipMakesALineOfTheFormulasWidth) {
  InkedSurface surface = gold();
  const Sideways<Length> from{Length(-500e-9), Length(0.0)}, to{Length(500e-9), Length(0.0)};
  const int ticks = 10'000;  // 100 nm/s at 1 kHz
  for (int i = 1; i <= ticks; ++i) {
    surface.touch(from + (to - from) * (static_cast<double>(i) / ticks), Time(1e-3));
  }
  EXPECT_NEAR(surface.width(from, to).si, 216e-9, 0.05 * 216e-9) << "a part of it flows ahead of the tip, as a head";
  EXPECT_NEAR(surface.covered().si, inked_area(kThiol, Time(10.0)).si, 5e-18);
  EXPECT_EQ(surface.lost().si, 0.0);
}

TEST(Ink, ADotGrowsAsTheSquareRootOfTimeWhereverTheTipPausesBefore) {
  InkedSurface surface = gold();
  for (int i = 0; i < 500; ++i) surface.touch({Length(0.0), Length(0.0)}, Time(1e-3));
  surface.touch({Length(4e-9), Length(0.0)}, Time(1e-3));
  for (int i = 0; i < 499; ++i) surface.touch({Length(0.0), Length(0.0)}, Time(1e-3));
  EXPECT_NEAR(surface.covered().si, inked_area(kThiol, Time(1.0)).si, 5e-18) << "none is laid twice";
}

TEST(Ink, WhatFindsNoBareSquareWithinReachIsLost) {
  InkedSurface surface(kThiol, {Length(0.0), Length(0.0)}, {Length(0.0), Length(0.0)}, Length(20e-9), Length(2e-9));
  for (int i = 0; i < 1000; ++i) surface.touch({Length(0.0), Length(0.0)}, Time(1e-3));
  EXPECT_GT(surface.lost().si, 1e-14);
  EXPECT_NEAR(surface.covered().si + surface.lost().si, inked_area(kThiol, Time(1.0)).si, 5e-18);
  surface.touch({Length(std::numeric_limits<double>::quiet_NaN()), Length(0.0)}, Time(1.0));
  surface.touch({Length(0.0), Length(0.0)}, Time(-1.0));
  EXPECT_NEAR(surface.covered().si + surface.lost().si, inked_area(kThiol, Time(1.0)).si, 5e-18) << "ignored";
}

// Fewer looks only delay the flow; tiles contain all covered places.
TEST(Ink, WithFewLooksALittleLater) {
  InkedSurface surface = gold(), slow = gold();
  const auto go = [](InkedSurface& inked, std::size_t most_looks) {
    for (int i = 0; i < 3000; ++i) {
      const double angle = 1e-3 * i;
      inked.touch({Length(60e-9 * std::cos(angle)), Length(60e-9 * std::sin(angle))}, Time(1e-3), most_looks);
    }
  };
  go(surface, std::numeric_limits<std::size_t>::max());
  go(slow, 64);
  const Area square = surface.spacing() * surface.spacing();
  EXPECT_NEAR(surface.covered().si, inked_area(kThiol, Time(3.0)).si, 1.01 * square.si);
  EXPECT_NEAR(slow.covered().si, surface.covered().si, 0.02 * surface.covered().si);
}

TEST(Ink, TilesCarryAllThatIsCovered) {
  InkedSurface surface = gold(), copy = gold();
  for (int i = 0; i < 2000; ++i) surface.touch({Length(1e-10 * i), Length(3e-11 * i)}, Time(1e-3));
  surface.lift();
  std::size_t changed = 0;
  for (std::size_t tile = 0; tile < surface.tiles(); ++tile) {
    std::array<std::uint8_t, InkedSurface::kTileSquares> covered{};
    surface.copy_tile(tile, covered);
    EXPECT_EQ(surface.changed(tile), std::count(covered.begin(), covered.end(), 1) > 0) << tile;
    changed += surface.changed(tile) ? 1U : 0U;
    surface.kept(tile);
    copy.put_tile(tile, covered);
  }
  EXPECT_GT(changed, 3U);
  EXPECT_EQ(copy.covered().si, surface.covered().si);
  for (InkedSurface* each : {&surface, &copy}) {
    for (int i = 0; i < 500; ++i) each->touch({Length(150e-9), Length(0.0)}, Time(1e-3));
  }
  for (std::size_t row = 0; row < surface.rows(); ++row) {
    for (std::size_t column = 0; column < surface.columns(); ++column) {
      ASSERT_EQ(surface.is_covered(column, row), copy.is_covered(column, row));
    }
  }
}

TEST(Ink, RefusesWhatCannotBe) {
  EXPECT_THROW(validate({.molecules_per_s = 0.0, .footprint = Area(1e-19)}), std::invalid_argument);
  EXPECT_THROW(validate({.molecules_per_s = 1e5, .footprint = Area(1e-10)}), std::invalid_argument);
  EXPECT_THROW(
      InkedSurface(kThiol, {Length(0.0), Length(0.0)}, {Length(1e-3), Length(0.0)}, Length(1e-9), Length(1e-9)),
      std::invalid_argument);
}

}  // namespace ink_test
}  // namespace afm::physics
