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
namespace {

using namespace literals;

// There and back, three times, over `stroke`.
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
  const Energy scale = LatticeLandscape::scale_of_row(LatticeKind::Rows, row.amplitude);
  tip.land({}, scale);
  const auto run = cycles(tip, [&](auto& t, const Sideways<Length>& to) { t.move_to(to, scale); }, 40.1e-9, 20'000);
  const auto loop = last_friction_loop(run);
  ASSERT_TRUE(loop);
  EXPECT_NEAR(loop->half_width.si, mean_friction(row).si, 0.01 * mean_friction(row).si);
  EXPECT_NEAR(loop->offset.si, 0.0, 0.01 * mean_friction(row).si);
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

TEST(FrictionLoop, NeedsAWholeCycle) {
  EXPECT_FALSE(last_friction_loop({}));
  std::vector<LateralPoint> there;
  for (int i = 0; i < 100; ++i) there.push_back({Length(1e-10 * i), 1_nN});
  EXPECT_FALSE(last_friction_loop(there));
  // no friction: the force follows the place both ways
  for (int i = 99; i >= 0; --i) there.push_back({Length(1e-10 * i), 1_nN});
  EXPECT_FALSE(last_friction_loop(there));
}

}  // namespace
}  // namespace afm::physics
