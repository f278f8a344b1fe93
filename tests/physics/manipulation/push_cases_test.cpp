// SPDX-License-Identifier: Apache-2.0
// Closed forms of the table of cases for pushed particles; the rows of paths and heaps are in
// pushed_particles_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>

#include "physics/adhesion_map.h"
#include "physics/elasticity.h"
#include "physics/imaging/height_grid.h"
#include "physics/imaging/morphology.h"
#include "physics/jkr.h"
#include "physics/law.h"
#include "physics/manipulation/particle_friction.h"
#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/tip_contact.h"
#include "physics/meniscus.h"
#include "pushing.h"

namespace afm::physics {
namespace push_cases_test {

using namespace literals;
using std::numbers::pi;
using test::degrees;
using test::expect_relative;
using test::flank_tip;
using test::gold;
using test::latex;
using test::travel_until_lost;

constexpr double kClosed = 1e-6;  // relative tolerance of the table

// Cost of the slip of a sphere at rest on the way to f_s: travel of the base, jump of the sphere, energy lost (M15).
struct FirstSlip {
  Length travel, jump;
  Energy lost;
};
FirstSlip first_slip(Force static_threshold, Force kinetic_threshold, Stiffness sideways) {
  return {static_threshold / sideways, (static_threshold - kinetic_threshold) / sideways,
          0.5 * (static_threshold * static_threshold - kinetic_threshold * kinetic_threshold) / sideways};
}

// A tip that a lever presses on the sample while it pushes a sphere: the rest of the load F_0, F_0 - N sin, which is at
// least 0 because the flank lifts the tip; and the lateral force on the lever, N cos with the friction of the tip under
// that load (M83).
struct PressedPush {
  Force load, lateral;
};
PressedPush pressed_push(const PushBalance& push, Force preload, double sample_friction) {
  const Force load{std::max(0.0, (preload - push.lift).si)};
  return {load, push.lateral + sample_friction * load};
}

// The largest mu_t at which any sphere rolls: cos/(1 + sin) = tan(pi/4 - phi/2) (M7).
double largest_rolling_friction(double half_angle_rad) {
  return std::cos(half_angle_rad) / (1.0 + std::sin(half_angle_rad));
}

double power_of_radius(ParticleSpecies species, Force load) {
  const double radius = species.contact.tip_radius.si;
  const auto threshold = [&](double factor) {
    species.contact.tip_radius = Length(radius * factor);
    return sliding_threshold(species, load).si;
  };
  return std::log(threshold(1.0001) / threshold(0.9999)) / std::log(1.0001 / 0.9999);
}

TEST(PushCases, N01TheContactOfGoldOnMica) {
  const ParticleSpecies species = gold();
  expect_relative(species.contact.reduced_modulus.si, 38710783890.0, kClosed);
  expect_relative(jkr_contact_radius(species.contact, Force(0.0)).si, 2.836635145e-09, kClosed);
  expect_relative(pull_off_force(species).si, 1.178097245e-08, kClosed);
}

TEST(PushCases, N02TaborsParameterOfGoldAndLatex) {
  const double expected[] = {0.1352043822, 0.1835005784, 0.2912890112, 0.9807858201, 1.677120161};
  const double radii[] = {10e-9, 25e-9, 100e-9, 50e-9, 250e-9};
  for (int i = 0; i < 5; ++i) {
    ParticleSpecies species = i < 3 ? gold() : latex();
    species.contact.tip_radius = Length(radii[i]);
    expect_relative(tabor_parameter(species, 0.3_nm), expected[i], kClosed);
  }
}

TEST(PushCases, N05TheExponentOfTheRadius) {
  EXPECT_NEAR(power_of_radius(gold(), Force(0.0)), 1.333333333, 1e-4);
  ParticleSpecies hertz = gold();
  hertz.contact.work_of_adhesion = SurfaceEnergy(1e-12);
  EXPECT_NEAR(power_of_radius(hertz, 100_nN), 0.6666666667, 1e-4);
  ParticleSpecies large = latex();
  large.contact.tip_radius = 100_nm;
  EXPECT_NEAR(power_of_radius(large, 100_nN), 1.015492573, 1e-4);
}

TEST(PushCases, N07TheThresholdOfGoldAndItsRolling) {
  expect_relative(sliding_threshold(gold(), Force(0.0)).si, 2.527882197e-10, kClosed);
  const ParticleSpecies species = gold();
  expect_relative((rolling_moment(species, Force(0.0)) / species.contact.tip_radius).si, 5.654866776e-10, kClosed);
}

TEST(PushCases, N09AndN11WhereFlankAndCapTouch) {
  const SideContact flank = side_contact(flank_tip(10_nm), 25_nm, Length(0.0));
  expect_relative(flank.distance.si, 4.02539042e-08, kClosed);
  expect_relative(degrees(std::asin(flank.sine)), 15.0, kClosed);
  EXPECT_TRUE(flank.on_flank);
  const SideContact cap = side_contact(flank_tip(10_nm), 25_nm, 30_nm);
  expect_relative(cap.distance.si, 3.16227766e-08, kClosed);
  expect_relative(degrees(std::asin(cap.sine)), 25.37693353, kClosed);
  EXPECT_FALSE(cap.on_flank);
}

TEST(PushCases, N13TheCrestOfTheFlank) {
  const Length crest = crest_height(flank_tip(10_nm), 25_nm);
  expect_relative(crest.si, 2.405866658e-08, 1e-9);
  expect_relative(side_contact(flank_tip(10_nm), 25_nm, crest).distance.si, 3.380740392e-08, 1e-9);
}

// In air the film of water pulls harder than the solid.
TEST(PushCases, N08AFilmOfWaterBelowGold) {
  const Meniscus water{.surface_tension = SurfaceEnergy(0.072)};
  const double share = capillary_force(water, gold().contact.tip_radius) / pull_off_force(gold());
  expect_relative(share, 1.92, kClosed);
}

// The paraboloid by which a felt surface is dilated is flatter than the cone of a real tip.
TEST(PushCases, N14AParaboloidBesideASphere) {
  const double step_m = 0.01e-9, radius_m = 25e-9;
  HeightGrid surface{.columns = 12000, .rows = 1, .column_step_m = step_m, .height_m = {}};
  for (std::size_t i = 0; i < surface.columns; ++i) {
    const double x = static_cast<double>(i) * step_m - 60e-9, squares = radius_m * radius_m - x * x;
    surface.height_m.push_back(squares > 0.0 ? radius_m + std::sqrt(squares) : -1e-6);
  }
  dilate_by_paraboloid(surface, 10_nm);
  std::size_t i = surface.columns / 2;
  while (surface.at(i, 0) > 0.0) ++i;
  const double slope = (surface.at(i, 0) - surface.at(i - 1, 0)) / step_m;
  const double at_m = static_cast<double>(i) * step_m - 60e-9 - surface.at(i, 0) / slope;
  expect_relative(at_m, 4.940066923e-08, kClosed);
  expect_relative(degrees(std::atan(-1.0 / slope)), 20.9932259, 1e-3);
}

TEST(PushCases, N15TheWidthOfAnImage) {
  const SphereCone tip = flank_tip(10_nm);
  expect_relative(side_contact(tip, 25_nm, Length(0.0)).distance / 25_nm, 1.610156168, kClosed);
  expect_relative(side_contact(tip, 25_nm, 25_nm).distance / 25_nm, 1.341640786, kClosed);
}

TEST(PushCases, N16AndN17SlideWithoutFrictionAtTheTip) {
  const double sine = std::sin(pi / 12.0), cosine = std::cos(pi / 12.0);
  ParticleSpecies amontons = gold();
  amontons.law = ParticleLaw::Amontons;
  amontons.coefficient = 0.3;
  amontons.rolling_distance = Length(0.0);
  const PushBalance by_load = push_balance(amontons, {}, sine, cosine);
  EXPECT_EQ(by_load.mode, PushMode::Slides);
  expect_relative(by_load.normal.si, 3.978803178e-09, kClosed);
  expect_relative(by_load.lateral.si, 3.843228747e-09, kClosed);
  expect_relative(by_load.lift.si, 1.029790039e-09, kClosed);
  ParticleSpecies area = latex();
  area.rolling_distance = Length(0.0);
  const PushBalance by_area = push_balance(area, {}, sine, cosine);
  expect_relative(by_area.normal.si, 3.408954384e-09, kClosed);
  expect_relative(by_area.lateral.si, 3.29279708e-09, kClosed);
  expect_relative(by_area.lift.si, 8.823023185e-10, kClosed);
}

// The flank lifts a tip that is pressed on the sample beside the gold of N16.
TEST(PushCases, N76APressedTipRubsTheSampleLess) {
  ParticleSpecies amontons = gold();
  amontons.law = ParticleLaw::Amontons;
  amontons.coefficient = 0.3;
  amontons.rolling_distance = Length(0.0);
  const PushBalance push = push_balance(amontons, {}, std::sin(pi / 12.0), std::cos(pi / 12.0));
  const PressedPush pressed = pressed_push(push, Force(5e-9), 0.2);
  expect_relative(pressed.lateral.si, 4.637270739e-09, kClosed);
  expect_relative(pressed.load.si, 3.970209961e-09, kClosed);
  EXPECT_EQ(pressed_push(push, Force(1e-9), 0.2).load.si, 0.0) << "lifted off";
  EXPECT_EQ(pressed_push(push, Force(1e-9), 0.2).lateral, push.lateral);
}

// Forces and moments by hand for whatever sphere and tip.
TEST(PushCases, TheMapOfSlidingAndRollingIsTheBalanceOfTenThousandMaterials) {
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const auto between = [&](double least, double most) { return least * std::pow(most / least, share(random)); };
  std::array<int, kPushModes.size()> seen{};
  for (int i = 0; i < 10'000; ++i) {
    ParticleSpecies species = gold();
    species.contact.tip_radius = Length(between(10e-9, 500e-9));
    species.contact.work_of_adhesion = SurfaceEnergy(between(0.01, 0.2));
    species.law = kParticleLaws.at(static_cast<std::size_t>(i) % 3).law;  // laws by area and load
    species.shear_strength = Pressure(between(1e6, 1e8));
    species.coefficient = between(0.05, 0.5);
    species.rolling_distance = Length(between(1e-11, 5e-9));
    const TipGrip grip{between(0.01, 1.0), Force(between(1e-12, 1e-8))};
    const double angle = between(0.1, 0.6), sine = std::sin(angle), cosine = std::cos(angle);
    const PushBalance push = push_balance(species, grip, sine, cosine);
    ++seen.at(static_cast<std::size_t>(push.mode));
    if (push.mode == PushMode::Jams) continue;
    const double threshold = sliding_threshold(species, push.lift).si;
    const double moment = (rolling_moment(species, push.lift) / species.contact.tip_radius).si;
    const double most = grip.coefficient * (push.normal + grip.adhesion).si, holds = std::max(0.0, threshold - moment);
    const double small = 1e-6 * (push.normal.si + threshold);
    EXPECT_NEAR(push.lateral.si, push.normal.si * cosine - push.friction.si * sine, small);
    EXPECT_NEAR(push.lift.si, push.normal.si * sine + push.friction.si * cosine, small);
    if (push.mode == PushMode::Slides) {
      EXPECT_NEAR(push.lateral.si, threshold, small);
      EXPECT_NEAR(push.friction.si, holds, small);
      EXPECT_LE(push.friction.si, most + small);
    } else {
      EXPECT_NEAR(push.friction.si, most, small);
      EXPECT_NEAR(push.lateral.si, moment + most, small);
      EXPECT_GE(holds, most - small);
    }
  }
  EXPECT_GT(seen[0], 2000);
  EXPECT_GT(seen[1], 2000);
}

TEST(PushCases, N19TheLargestFrictionThatLetsASphereRoll) {
  const double expected[] = {1.0, 0.8390996312, 0.767326988, 0.6370702608};
  const double angles[] = {0.0, 10.0, 15.0, 25.0};
  for (int i = 0; i < 4; ++i) expect_relative(largest_rolling_friction(angles[i] * pi / 180.0), expected[i], 1e-9);
}

TEST(PushCases, N20GoldSlides) {
  ParticleSpecies species = gold();
  species.tip_adhesion = SurfaceEnergy(0.05);
  const Length radius = effective_radius(flank_tip(10_nm), 25_nm, true);
  const TipGrip grip{0.3, 1.5 * pi * species.tip_adhesion * radius};
  const PushBalance balance = push_balance(species, grip, std::sin(pi / 12.0), std::cos(pi / 12.0));
  EXPECT_EQ(balance.mode, PushMode::Slides);
  expect_relative(balance.normal.si, 2.622075397e-10, kClosed);
  expect_relative(balance.lateral.si, 2.532730344e-10, kClosed);
}

TEST(PushCases, N23TheMomentOfSpinning) {
  expect_relative(spinning_share(latex(), Force(0.0)), 0.1236589584, kClosed);
  expect_relative(spinning_share(gold(), Force(0.0)), 0.07564360386, kClosed);
}

TEST(PushCases, N24AndN25TheGentleLoad) {
  expect_relative(gentle_load(gold(), flank_tip(10_nm), 0.0).si, 6.786430504e-11, kClosed);
  expect_relative(gentle_load(latex(), flank_tip(10_nm), 0.0).si, 8.823023185e-10, kClosed);
  expect_relative(gentle_load(latex(), flank_tip(10_nm), 0.1).si, 5.353868295e-10, kClosed);
  EXPECT_EQ(gentle_load(latex(), flank_tip(10_nm), 0.2679491924 * (1.0 + 1e-9)), Force(0.0));
  EXPECT_GT(gentle_load(latex(), flank_tip(10_nm), 0.2679491924 * (1.0 - 1e-6)), Force(0.0));
}

TEST(PushCases, N26TheSoftestLeverThatPushes) {
  expect_relative(softest_lever(gold(), flank_tip(10_nm)).si, 0.002820784137, 1e-5);
  expect_relative(softest_lever(latex(), flank_tip(20_nm)).si, 0.01833647587, 1e-5);
}

TEST(PushCases, N27TheSpringsInSeries) {
  const PushSprings springs{10_N_per_m, 1_N_per_m, 100_N_per_m};
  const double sine = std::sin(pi / 12.0), cosine = std::cos(pi / 12.0);
  expect_relative(stiffness_along_normal(springs, sine, cosine).si, 5.8723848, 1e-9);
  expect_relative(stiffness_sideways(springs, sine, cosine).si, 5.479009608, 1e-9);
}

TEST(PushCases, N28TheFirstSlip) {
  const FirstSlip slip = first_slip(3_nN, 1.5_nN, Stiffness(5.479009608));
  expect_relative(slip.travel.si, 5.475442123e-10, kClosed);
  expect_relative(slip.jump.si, 2.737721061e-10, kClosed);
  expect_relative(slip.lost.si, 6.159872388e-19, kClosed);
}

TEST(PushCases, N32AndN33Aim) {
  const double offsets[] = {0.2, 0.05, 0.01, 0.001};
  const double travels[] = {2.29243167, 3.688253867, 5.298292366, 7.60090221};
  for (int i = 0; i < 4; ++i) expect_relative(travel_until_lost(offsets[i]), travels[i], kClosed);
  const double pushes[] = {3.0, 5.0, 10.0};
  const double aims[] = {0.09932792742, 0.01347528222, 9.079985934e-05};
  for (int i = 0; i < 3; ++i) expect_relative(largest_offset(pushes[i]), aims[i], 1e-9);
}

TEST(PushCases, N39TheFastestHandThatSteers) {
  // at a scale of 1e5, as felt by the hand
  expect_relative(1e5 * fastest_steering(40_nm, Time(0.25)).si, 0.016, 1e-9);
  expect_relative(1e5 * fastest_steering(40_nm, Time(0.15)).si, 0.02666666667, 1e-9);
}

TEST(PushCases, N55TheRadiusOfTheFlankAndItsPull) {
  const Length radius = effective_radius(flank_tip(10_nm), 25_nm, true);
  expect_relative(radius.si, 15.813449e-9, kClosed);
  expect_relative(1.5 * pi * 0.05 * radius.si * std::cos(pi / 12.0), 3.598997214e-09, kClosed);
}

TEST(PushCases, N82TheLargestPush) {
  const double stiffness[] = {0.1, 1.0, 40.0};
  const double alone[] = {8.978816603e-09, 8.978816603e-08, 3.591526641e-06};
  const double pressed[] = {1.644291822e-08, 9.725226765e-08, 3.598990743e-06};
  for (int i = 0; i < 3; ++i) {
    expect_relative(largest_push(flank_tip(10_nm), 25_nm, Stiffness(stiffness[i]), Force(0.0)).si, alone[i], kClosed);
    expect_relative(largest_push(flank_tip(10_nm), 25_nm, Stiffness(stiffness[i]), 2_nN).si, pressed[i], kClosed);
  }
}

TEST(PushCases, N84TheWorkOfANanometre) {
  const double kt = thermal_energy(Temperature(298.15)).si;
  expect_relative(sliding_threshold(gold(), Force(0.0)).si * 1e-9 / kt, 61.40994875, kClosed);
  ParticleSpecies slides = latex();
  slides.rolling_distance = Length(0.0);
  const PushBalance balance = push_balance(slides, {}, std::sin(pi / 12.0), std::cos(pi / 12.0));
  expect_relative(balance.lateral.si * 1e-9 / kt, 799.9205825, kClosed);
}

TEST(PushCases, RollingNeverHappensAboveItsLargestFriction) {
  ParticleSpecies species = latex();
  species.rolling_distance = 0.3_nm;
  const double angle = pi / 12.0;
  const PushBalance below = push_balance(species, {0.1, Force(0.0)}, std::sin(angle), std::cos(angle));
  EXPECT_EQ(below.mode, PushMode::Rolls);
  // forces and moments of a rolling sphere balance: M = R (friction on the sample - T)
  const Torque moment = rolling_moment(species, below.lift);
  EXPECT_NEAR((below.lateral - below.friction).si, (moment / species.contact.tip_radius).si, 1e-21);
  const double most = largest_rolling_friction(angle);
  EXPECT_EQ(push_balance(species, {most * 1.01, Force(0.0)}, std::sin(angle), std::cos(angle)).mode, PushMode::Slides);
}

}  // namespace push_cases_test
}  // namespace afm::physics
