// SPDX-License-Identifier: Apache-2.0
// Flat islands: discs that the tip pushes at their rim, and that turn.
// Invariant: no path of the hand gains energy from flat islands
#include "physics/manipulation/island.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/tip_meeting.h"
#include "pushing.h"

namespace afm::physics {
namespace island_test {

using test::base_at;
using test::degrees;
using test::drag;
using test::expect_relative;
using test::flank_tip;
using test::travel_until_lost;

constexpr Length kRadius{97.7e-9}, kRim{25e-9};
constexpr Force kThreshold{30e-9};
constexpr double kRates[] = {500.0, 1000.0, 4000.0};

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

// alpha after a travel over rho, from alpha_0 below a quarter turn, at most that (M43).
double island_angle_after(double travel_over_rho, double angle_rad, double tip_friction) {
  const double sign = angle_rad < 0.0 ? -1.0 : 1.0, from_rad = std::abs(angle_rad);
  if (from_rad == 0.0 || from_rad >= kQuarterTurn) return angle_rad;
  const double slips_rad = largest_sticking_angle(tip_friction);
  double at_rad = from_rad, left = travel_over_rho;
  if (from_rad < slips_rad) {
    const double sticks =
        std::min(left, std::log(std::tan(0.5 * slips_rad) / std::tan(0.5 * from_rad)) / kIslandTurning);
    at_rad = 2.0 * std::atan(std::tan(0.5 * from_rad) * std::exp(kIslandTurning * sticks));
    left -= sticks;
  }
  if (left > 0.0) {
    const double delta = std::atan(tip_friction);
    const double half = std::tan(0.5 * (at_rad - delta)) * std::exp(left / std::cos(delta));
    at_rad = std::min(kQuarterTurn, delta + 2.0 * std::atan(half));
  }
  return sign * at_rad;
}

ParticleSpecies island(double kinetic_ratio = 1.0) {
  ParticleSpecies species;
  species.law = ParticleLaw::Measured;
  species.contact.tip_radius = kRim;
  species.island_radius = kRadius;
  species.measured_threshold = kThreshold;
  species.kinetic_ratio = kinetic_ratio;
  species.ageing = Time(0.1);
  return species;
}

PushSetup setup_of(double tip_friction, const PushSprings& springs, double kinetic_ratio = 1.0) {
  return {flank_tip(Length(10e-9)), springs, tip_friction, {island(kinetic_ratio)}};
}

constexpr PushSprings kStiff{Stiffness(1e5), Stiffness(1e5), Stiffness(1e6)};
constexpr PushSprings kSoft{Stiffness(0.7), Stiffness(0.7), Stiffness(70.0)};

double rho_m(const PushSetup& setup) {
  return (core_radius(setup.species[0]) + side_contact(setup.tip, kRim, Length(0.0)).distance).si;
}

// One island ahead of the base along x, at the angle alpha above it.
PushedParticles island_at(const PushSetup& setup, double alpha_rad, double gap_m = 0.0) {
  const double away_m = rho_m(setup);
  return {setup,
          {{.position = {Length(away_m * std::cos(alpha_rad) + gap_m), Length(away_m * std::sin(alpha_rad))}}},
          base_at(0.0)};
}

double alpha_of(const PushedParticles& particles) {
  const Sideways<Length> way = particles.position(0) - particles.last().base.position;
  return std::atan2(way.y.si, way.x.si);
}

// N80: friction of a disc with uniform pressure, summed over rings and angles, for a turn about a point of its rim.
TEST(LimitSurfaceOfADisc, IsAnEllipsoidUpToSomePercent) {
  double force = 0.0, moment = 0.0, all = 0.0, all_moment = 0.0;
  const int rings = 400, sectors = 1600;
  for (int r = 0; r < rings; ++r) {
    const double radius = (r + 0.5) / rings;
    for (int s = 0; s < sectors; ++s) {
      const double angle = 2.0 * std::numbers::pi * (s + 0.5) / sectors;
      const double x = radius * std::cos(angle), y = radius * std::sin(angle);
      // the pivot is at x = -1: the velocity of the point is (-y, x + 1)
      const double speed = std::hypot(y, x + 1.0);
      force += radius * (x + 1.0) / speed;
      moment += radius * (x * (x + 1.0) + y * y) / speed;
      all += radius;
      all_moment += radius * radius;
    }
  }
  const double f = force / all, m = moment / all_moment;
  expect_relative(f, 0.8488263336, 1e-3);
  expect_relative(m, 0.4244130489, 1e-3);
  expect_relative(f * f + m * m, 0.9006325806, 1e-3);
  // for the ellipsoid the friction is the work of the same motion, and too large by half of the missing part
  const double exact = f * 1.0 + m * 2.0 / 3.0;
  expect_relative(island_way(1.0, 1.0, 1.0), exact, 0.065);
  EXPECT_GT(island_way(1.0, 1.0, 1.0), exact);
}

// N34, with a tip that holds until the end.
TEST(IslandThatTheTipHolds, IsLostMoreSlowlyThanASphere) {
  const double holds = 1e9;
  expect_relative(degrees(island_angle_after(3.0, std::asin(0.01), holds)), 4.569823316, 1e-6);
  expect_relative(island_travel_until_lost(0.05, holds), 5.327477808, 1e-6);
  expect_relative(kIslandTurning, 0.6923076923, 1e-9);
  EXPECT_GT(island_travel_until_lost(0.05, holds), travel_until_lost(0.05));
  // without friction at the tip the island does not turn
  expect_relative(island_travel_until_lost(0.05, 0.0), travel_until_lost(0.05), 1e-9);
  EXPECT_EQ(island_angle_after(3.0, 0.0, 0.3), 0.0);
  expect_relative(island_angle_after(2.0, -0.1, 0.3), -island_angle_after(2.0, 0.1, 0.3), 1e-15);
}

// The closed forms against the equations of motion, integrated: tip and rim stick up to tan(alpha) = 3.25 mu_t, beyond
// it the island's middle goes across by mu_t of what it goes along (N35).
TEST(IslandThatTheTipHolds, SlipsAlongItsRimBeyondTheStickingAngle) {
  const double mu = 0.3;
  expect_relative(std::tan(largest_sticking_angle(mu)), 3.25 * mu, 1e-12);
  const double step = 1e-5;
  double alpha = 0.05, travel = 0.0;
  const auto rate = [mu](double a) {
    const double across = std::min(std::tan(a) / 3.25, mu);  // ratio of the middle's path across to that along
    return std::sin(a) - across * std::cos(a);
  };
  while (alpha < 0.5 * std::numbers::pi && travel < 10.0) {
    const double middle = alpha + 0.5 * step * rate(alpha);
    alpha += step * rate(std::min(middle, 1.5707));
    travel += step;
    if (std::abs(travel - 4.0) < 0.5 * step) {
      EXPECT_NEAR(alpha, island_angle_after(4.0, 0.05, mu), 1e-6);
    }
  }
  EXPECT_NEAR(travel, island_travel_until_lost(std::sin(0.05), mu), 3e-4);
}

TEST(IslandUnderTheTip, FollowsTheClosedFormAtAnyRate) {
  for (const double mu : {0.3, 10.0}) {
    const PushSetup setup = setup_of(mu, kStiff);
    for (const double rate_hz : kRates) {
      PushedParticles particles = island_at(setup, std::asin(0.01));
      drag(particles, base_at(3.0 * rho_m(setup)), 1e-6, rate_hz);
      EXPECT_NEAR(alpha_of(particles), island_angle_after(3.0, std::asin(0.01), mu), 1e-4) << mu << " " << rate_hz;
      // tip and rim roll on each other
      const double turned = angle_rad(particles.turn(0)), way = alpha_of(particles) - std::asin(0.01);
      EXPECT_NEAR(turned, way * rho_m(setup) / kRadius.si, 1e-3 * way);
      EXPECT_EQ(particles.last().state, PushState::Slides);
    }
  }
}

TEST(IslandUnderTheTip, SlipsAlongItsRimAtAnyRate) {
  const PushSetup setup = setup_of(0.2, kStiff);
  for (const double rate_hz : kRates) {
    PushedParticles particles = island_at(setup, 0.4);
    drag(particles, base_at(1.2 * rho_m(setup)), 1e-6, rate_hz);
    const double expected = island_angle_after(1.2, 0.4, 0.2);
    EXPECT_GT(expected, largest_sticking_angle(0.2) + 0.2);
    EXPECT_NEAR(alpha_of(particles), expected, 2e-4) << rate_hz;
  }
}

TEST(IslandUnderTheTip, IsLostAtAQuarterTurn) {
  const PushSetup setup = setup_of(0.3, kStiff);
  PushedParticles particles = island_at(setup, std::asin(0.1));
  const double lost = island_travel_until_lost(0.1, 0.3);
  drag(particles, base_at((lost - 0.02) * rho_m(setup)), 1e-6, 1000.0);
  const Sideways<Length> before = particles.position(0);
  EXPECT_GT(degrees(alpha_of(particles)), 80.0);
  drag(particles, base_at((lost + 1.0) * rho_m(setup)), 1e-6, 1000.0);
  EXPECT_LT(magnitude(particles.position(0) - before).si, 0.02 * rho_m(setup));
  EXPECT_EQ(particles.last().particle, kNoParticle);
}

TEST(IslandUnderTheTip, GivesAtItsThresholdAtAnyRateAndSpeed) {
  const PushSetup setup = setup_of(0.3, kSoft, 0.5);
  for (const double rate_hz : kRates) {
    for (const double speed : {0.1e-6, 2e-6}) {
      PushedParticles particles = island_at(setup, 0.0, 5e-9);
      double most_n = 0.0;
      for (int i = 0; i < 200'000 && particles.last().yields == 0; ++i) {
        most_n = std::max(most_n, particles.last().lateral.x.si * -1.0);
        drag(particles, base_at(particles.last().base.position.x.si + speed / rate_hz), speed, rate_hz);
      }
      EXPECT_EQ(particles.last().yields, 1U);
      expect_relative(particles.last().gave_at.si, kThreshold.si, 1e-9);
      expect_relative(particles.last().goes_on_at.si, 0.5 * kThreshold.si, 1e-9);
      expect_relative(magnitude(particles.last().lateral).si, 0.5 * kThreshold.si, 1e-6);
      EXPECT_LE(most_n, kThreshold.si * (1.0 + 1e-9));
      EXPECT_EQ(particles.turn(0), half_turn(0.0)) << "pushed through its middle";
    }
  }
}

// The lever bends by a third of the way to the middle here, so that the path depends on it, but not on the ticks.
TEST(IslandUnderTheTip, EndsAtTheSamePlaceAtAnyRate) {
  const PushSetup setup = setup_of(0.3, kSoft, 0.5);
  std::vector<Sideways<Length>> ends;
  std::vector<double> turns;
  for (const double rate_hz : kRates) {
    PushedParticles particles = island_at(setup, 0.15, 5e-9);
    drag(particles, base_at(150e-9), 0.5e-6, rate_hz);
    drag(particles, base_at(250e-9, 60e-9), 0.5e-6, rate_hz);
    ends.push_back(particles.position(0));
    turns.push_back(angle_rad(particles.turn(0)));
    EXPECT_GT(magnitude(ends.back() - island_at(setup, 0.15, 5e-9).position(0)).si, 100e-9);
  }
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_LT(magnitude(ends[i] - ends[2]).si, 2e-4 * rho_m(setup)) << i;
    EXPECT_NEAR(turns[i], turns[2], 4e-4) << i;
  }
  EXPECT_GT(std::abs(turns[2]), 0.02);
}

TEST(IslandUnderTheTip, BearsATipOnItsTop) {
  const PushSetup setup = setup_of(0.3, kSoft, 0.5);
  PushedParticles particles = island_at(setup, 0.0, 200e-9);
  const double middle_m = particles.position(0).x.si;
  drag(particles, base_at(0.0, 0.0, 80e-9), 1e-6, 1000.0);
  drag(particles, base_at(middle_m + 20e-9, 0.0, 80e-9), 1e-6, 1000.0);
  drag(particles, base_at(middle_m + 20e-9, 0.0, 40e-9), 1e-6, 1000.0);
  const PushTick& tick = particles.last();
  EXPECT_EQ(tick.particle, 0U);
  EXPECT_NEAR(tick.apex.z.si, 2.0 * kRim.si, 0.2e-9);
  EXPECT_GT(tick.lift.si, 5e-9);
  EXPECT_LT(magnitude(tick.lateral).si, 1e-3 * tick.lift.si);
  // across the flat top and down beyond it
  drag(particles, base_at(middle_m + 60e-9, 0.0, 40e-9), 1e-6, 1000.0);
  EXPECT_NEAR(particles.last().apex.z.si, 2.0 * kRim.si, 0.2e-9);
  EXPECT_NEAR(particles.position(0).x.si, middle_m, 1e-12);
}

// Two islands in a row need the force of both (N44).
TEST(Islands, PushEachOther) {
  const PushSetup setup = setup_of(0.3, kStiff);
  const double away_m = rho_m(setup);
  PushedParticles particles(setup,
                            {{.position = {Length(away_m + 1e-9), Length(0.0)}},
                             {.position = {Length(away_m + 1e-9 + 2.0 * kRadius.si + 20e-9), Length(0.0)}}},
                            base_at(0.0));
  drag(particles, base_at(60e-9), 0.2e-6, 1000.0);
  EXPECT_EQ(particles.last().state, PushState::Several);
  expect_relative(magnitude(particles.last().lateral).si, 2.0 * kThreshold.si, 1e-3);
  EXPECT_NEAR((particles.position(1) - particles.position(0)).x.si, 2.0 * kRadius.si, 1e-12);
}

TEST(Islands, AreRefusedWhereTheyCannotBe) {
  PushSetup setup = setup_of(0.3, kSoft);
  EXPECT_NO_THROW(validate(setup));
  setup.species.push_back(test::gold());
  EXPECT_THROW(validate(setup), UnphysicalValue) << "among spheres";
  setup.species.pop_back();
  setup.pads.push_back({{}, {Length(1e-7), Length(1e-7)}, SurfaceEnergy(0.1)});
  EXPECT_THROW(validate(setup), UnphysicalValue) << "on a pad";
  setup.pads.clear();
  const PlacedParticle first{.position = {}}, second{.position = {Length(1.99 * kRadius.si), Length(0.0)}},
      beside{.position = {Length(2.01 * kRadius.si), Length(0.0)}};
  EXPECT_THROW(validate(setup, {first, second}), std::invalid_argument) << "overlap";
  EXPECT_NO_THROW(validate(setup, {first, beside}));
  setup.species[0].rolling_distance = Length(1e-9);
  EXPECT_THROW(validate(setup), UnphysicalValue);
  setup.species[0] = island();
  setup.species[0].island_radius = kRim;
  EXPECT_THROW(validate(setup), UnphysicalValue) << "not flat";
}

// Energy of lever and contacts from the published state, by formulas of this test.
double energy_of(const PushSetup& setup, const PushedParticles& particles) {
  const PushTick& tick = particles.last();
  const double x = (tick.apex.position.x - tick.base.position.x).si,
               y = (tick.apex.position.y - tick.base.position.y).si, z = (tick.apex.z - tick.base.z).si;
  double energy = 0.5 * (setup.springs.lateral.si * (x * x + y * y) + setup.springs.normal.si * z * z);
  const double core_m = core_radius(setup.species[0]).si, k = setup.springs.contact.si;
  const TipProfile profile(setup.tip, kRim);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double away_m = std::max(0.0, magnitude(particles.position(i) - tick.apex.position).si - core_m);
    const double depth_m = std::max(0.0, profile.overlap(away_m, tick.apex.z.si).depth_m);
    energy += 0.5 * k * depth_m * depth_m;
    for (std::size_t j = 0; j < i; ++j) {
      const double between = 2.0 * kRadius.si - magnitude(particles.position(i) - particles.position(j)).si;
      if (between > 0.0) energy += 0.5 * k * between * between;
    }
  }
  return energy;
}

// A hand that wanders at random through and over islands never gains energy, and never loses track of it.
TEST(Islands, GiveNoEnergyToARandomHand) {
  std::mt19937_64 random(20261129);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  std::size_t closed = 0, ticks = 0;
  for (int run = 0; run < 40; ++run) {
    const auto spring = [&](double low, double high) {
      return Stiffness(std::exp(uniform(std::log(low), std::log(high))));
    };
    PushSetup setup =
        setup_of(uniform(0.0, 1.0), {spring(0.3, 100.0), spring(0.1, 40.0), spring(30.0, 1000.0)}, uniform(0.2, 1.0));
    setup.species[0].ageing = Time(run % 3 == 0 ? 0.0 : 0.1);
    const int count = run % 2 == 0 ? 1 : 5;
    std::vector<PlacedParticle> places;
    for (int i = 0; i < count; ++i) {
      places.push_back({.position = {Length((i % 3) * 230e-9), Length((i / 3) * 230e-9)}, .pinned = i == 4});
    }
    PushedParticles particles(setup, places, base_at(-130e-9, uniform(-90e-9, 90e-9)));
    const double at_start = particles.last().stored.si - particles.last().given.si;
    double last_margin = 0.0;
    double speed = uniform(0.01e-9, 3e-9), angle = uniform(-1.0, 1.0), x = -130e-9, y = 0.0, z = 0.0;
    for (int i = 0; i < 3000; ++i, ++ticks) {
      angle += uniform(-0.4, 0.4);
      if (i % 300 == 0) speed = uniform(0.01e-9, 3e-9);
      if (i % 150 == 149) {  // return towards the middle
        angle = std::atan2((count > 1 ? 115e-9 : 0.0) - y, (count > 1 ? 230e-9 : 0.0) - x);
      }
      x += speed * std::cos(angle);
      y += speed * std::sin(angle);
      z = std::clamp(z + uniform(-1e-9, 1e-9), -30e-9, 60e-9);
      const auto moved_before = particles.last().lost;
      const PushTick& tick = particles.move_to(base_at(x, y, z), Time(1e-3));
      const double margin = tick.given.si - tick.lost.si - tick.stored.si + at_start;
      ASSERT_GE(margin, -1e-12 * std::abs(tick.given.si)) << run << " " << i;
      ASSERT_GE(margin, last_margin - 1e-13 * std::abs(tick.given.si)) << "a step that raises energy and friction";
      last_margin = margin;
      ASSERT_GE(tick.lost.si, moved_before.si);
      ASSERT_NEAR(tick.stored.si, energy_of(setup, particles), 1e-9 * tick.given.si + 1e-24) << run << " " << i;
      const HalfTurn turn = particles.turn(0);
      ASSERT_NEAR(turn.w * turn.w + turn.z * turn.z, 1.0, 1e-12);
      if (std::abs(turn.z) > 1e-6 && tick.state == PushState::Slides) ++closed;
    }
  }
  EXPECT_GT(closed, ticks / 100) << "the hand has turned islands";
}

}  // namespace island_test
}  // namespace afm::physics
