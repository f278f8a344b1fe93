// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/friction_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "physics/friction/anchored_tip.h"
#include "physics/friction/lattice_tip.h"
#include "physics/friction/prandtl_tomlinson.h"

namespace afm::physics {
namespace friction_loop_test {

using namespace literals;

// Moves back and forth over `stroke`, three times.
template <class Tip, class Hold>
std::vector<LateralPoint> cycles(Tip& tip, const Hold& hold, double stroke_m, int points) {
  std::vector<LateralPoint> run;
  for (int i = 0; i <= 6 * points; ++i) {
    const double phase = static_cast<double>(i % (2 * points)) / points;
    const double x = stroke_m * (phase < 1.0 ? phase : 2.0 - phase);
    hold(tip, {Length(x), Length()});
    run.push_back({Length(x), -tip.force().x});
  }
  return run;
}

TEST(FrictionLoop, HasTheYieldForceOffsetAndSpringOfDryFriction) {
  AnchoredTip tip(3_N_per_m);
  tip.land({});
  auto run = cycles(tip, [](auto& t, const Sideways<Length>& to) { t.move_to(to, 0.7_nN); }, 10e-9, 2000);
  for (LateralPoint& point : run) point.force = point.force + 0.15_nN;
  const auto loop = last_friction_loop(run);
  ASSERT_TRUE(loop);
  EXPECT_NEAR(loop->half_width.si, 0.7e-9, 1e-3 * 0.7e-9);
  EXPECT_NEAR(loop->offset.si, 0.15e-9, 1e-3 * 0.7e-9);
  EXPECT_NEAR(loop->slope.si, 3.0, 3e-3);
}

TEST(FrictionLoop, HasTheMeanForceOfAStickSlip) {
  const SineLattice row{0.5_nm, Energy(6.33257397764611e-20), 1_N_per_m};
  LatticeTip tip(LatticeKind::Rows, row.period, row.spring);
  const Energy scale = scale_of_row(LatticeKind::Rows, row.amplitude);
  tip.land({}, scale);
  const auto run = cycles(tip, [&](auto& t, const Sideways<Length>& to) { t.move_to(to, scale); }, 40.1e-9, 20'000);
  const auto loop = last_friction_loop(run);
  ASSERT_TRUE(loop);
  EXPECT_NEAR(loop->half_width.si, mean_friction(row).si, 0.01 * mean_friction(row).si);
  EXPECT_NEAR(loop->offset.si, 0.0, 0.01 * mean_friction(row).si);
}

// Below the corrugation at which the tip jumps, both strokes have the same forces: only the rounding of sums differs.
TEST(FrictionLoop, HasNoWidthWhereTheTipSlidesWithoutJumps) {
  const SineLattice row{0.5_nm, Energy(2e-21), 1_N_per_m};
  LatticeTip tip(LatticeKind::Rows, row.period, row.spring);
  const Energy scale = scale_of_row(LatticeKind::Rows, row.amplitude);
  tip.land({}, scale);
  for (const double stroke_m : {10.1e-9, 40.1e-9, 33.333e-9}) {
    const auto run = cycles(tip, [&](auto& t, const Sideways<Length>& to) { t.move_to(to, scale); }, stroke_m, 777);
    const auto loop = last_friction_loop(run);
    ASSERT_TRUE(loop);
    EXPECT_EQ(loop->half_width.si, 0.0);
    EXPECT_EQ(loop->dissipated.si, 0.0);
  }
}

TEST(FrictionLoop, IsFoundUnderNoise) {
  AnchoredTip tip(3_N_per_m);
  tip.land({});
  auto run = cycles(tip, [](auto& t, const Sideways<Length>& to) { t.move_to(to, 0.7_nN); }, 10e-9, 2000);
  std::mt19937_64 random(3);
  std::normal_distribution<double> noise(0.0, 0.01e-9);
  for (LateralPoint& point : run) point.force = point.force + Force(noise(random));
  const auto loop = last_friction_loop(run);
  ASSERT_TRUE(loop);
  EXPECT_NEAR(loop->half_width.si, 0.7e-9, 0.01 * 0.7e-9);
}

TEST(FrictionLoop, IsTheLastClosedOneWhileTheNextStrokeStillSticks) {
  AnchoredTip tip(3_N_per_m);
  tip.land({});
  auto run = cycles(tip, [](auto& t, const Sideways<Length>& to) { t.move_to(to, 0.7_nN); }, 10e-9, 2000);
  const std::size_t closed = run.size() - 1;
  for (int i = 1; i <= 202; ++i) {  // path shorter than the sticking at both ends
    const Length x(10e-9 * i / 2000.0);
    tip.move_to({x, Length()}, 0.7_nN);
    run.push_back({x, -tip.force().x});
  }
  const auto loop = last_friction_loop(run);
  ASSERT_TRUE(loop);
  EXPECT_EQ(loop->end, closed);
  EXPECT_EQ(loop->turn, closed - 2000);
  EXPECT_EQ(loop->begin, closed - 4000);
  EXPECT_NEAR(loop->half_width.si, 0.7e-9, 1e-3 * 0.7e-9);
}

TEST(FrictionLoop, LiesAlongTheLineOfTheLargestSpread) {
  std::vector<SidewaysPoint> points;
  for (int i = -10; i <= 10; ++i) {
    points.push_back({{Length(3e-10 * i), Length(-4e-10 * i)}, {Force(3e-10), Force(-4e-10)}});
  }
  const auto run = along_main_line(points);
  ASSERT_EQ(run.size(), points.size());
  EXPECT_NEAR(run.back().place.si, 5e-9, 1e-20) << "it leads to +x";
  EXPECT_NEAR(run.back().force.si, -5e-10, 1e-21);
  EXPECT_TRUE(along_main_line({}).empty());
}

TEST(FrictionLoop, NeedsAWholeCycle) {
  EXPECT_FALSE(last_friction_loop({}));
  std::vector<LateralPoint> there;
  for (int i = 0; i < 100; ++i) there.push_back({Length(1e-10 * i), 1_nN});
  EXPECT_FALSE(last_friction_loop(there));
  // no friction: the force depends only on the place, in both directions
  for (int i = 99; i >= 0; --i) there.push_back({Length(1e-10 * i), 1_nN});
  EXPECT_FALSE(last_friction_loop(there));
}

}  // namespace friction_loop_test
}  // namespace afm::physics
