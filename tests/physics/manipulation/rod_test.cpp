// SPDX-License-Identifier: Apache-2.0
// Rods: closed forms and paths of the table of cases.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "manipulation/line_friction.h"
#include "physics/contact_parameters.h"
#include "physics/manipulation/pattern.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/rod.h"
#include "physics/manipulation/tip_contact.h"
#include "pushing.h"

namespace afm::physics {
namespace rod_test {

using namespace literals;
using test::base_at;
using test::degrees;
using test::drag;
using test::expect_relative;
using test::flank_tip;

constexpr double kClosed = 1e-6;  // relative tolerance of the table
constexpr double kLengthM = 1e-6, kRadiusM = 2e-9, kThresholdN = 1e-9;

ParticleSpecies rod_species(double kinetic_ratio = 1.0) {
  ParticleSpecies rod;
  rod.law = ParticleLaw::Measured;
  rod.contact.tip_radius = Length(kRadiusM);
  rod.length = Length(kLengthM);
  rod.measured_threshold = Force(kThresholdN);
  rod.kinetic_ratio = kinetic_ratio;
  rod.ageing = Time(0.1);
  return rod;
}

// Thin rod and tip, hardly bent: the closed forms are those of lines and points.
PushSetup thin_setup(double kinetic_ratio = 1.0) {
  return {flank_tip(Length(kRadiusM)), {100_N_per_m, 40_N_per_m, 1000_N_per_m}, 0.0, {rod_species(kinetic_ratio)}};
}

double touch_m() { return side_contact(flank_tip(Length(kRadiusM)), Length(kRadiusM), Length(0.0)).distance.si; }

// A rod along x in the middle, and a tip lowered beside it at the distance s from its middle.
PushedParticles lowered_beside(double s_m, const PushSetup& setup = thin_setup(), double rate_hz = 1000.0) {
  PushedParticles particles(setup, {{.species = 0, .position = {}}}, base_at(s_m, -20e-9, 10e-9));
  drag(particles, base_at(s_m, -20e-9), 1e-7, rate_hz);
  return particles;
}

struct RodPlace {
  double x = 0.0, y = 0.0, angle = 0.0;  // place relative to the length, and angle in rad
};

RodPlace place_of(const PushedParticles& particles) {
  const Sideways<Length> at = particles.position(0);
  return {at.x.si / kLengthM, at.y.si / kLengthM, angle_rad(particles.turn(0))};
}

TEST(Rod, N46TheForceAgainstThePlace) {
  const double places[] = {0.0, 0.1, 0.25, 0.4, 0.5};
  const double forces[] = {1.0, 0.8198039027, 0.6180339887, 0.4806248475, 0.4142135624};
  for (int i = 0; i < 5; ++i) {
    expect_relative(rod_threshold(Force(1.0), Length(1.0), Length(places[i])).si, forces[i], kClosed);
    // the limit surface gives the same, and the pivot's motion
    const DrivenMotion driven = driven_motion({0.0, 1.0, 2.0 * places[i]});
    expect_relative(1.0 / driven.force, forces[i], 1e-9);
    if (i > 0) expect_relative(driven.motion[1] / driven.motion[2], forces[i], 1e-5);  // d = F/2q
  }
}

TEST(Rod, N47PushedInTheMiddleItDoesNotTurn) {
  PushedParticles particles = lowered_beside(0.0);
  drag(particles, base_at(0.0, 0.2e-6), 1e-6, 1000.0);
  const RodPlace at = place_of(particles);
  EXPECT_NEAR(at.angle, 0.0, 1e-6);
  EXPECT_NEAR(at.x, 0.0, 1e-9);
  EXPECT_GT(at.y, 0.2);
  expect_relative(magnitude(particles.last().lateral).si, kThresholdN, 1e-6);
}

// dphi = cos(phi) dx/(s + d), the middle moves by d dphi across, and ds = sin(phi) dx - rho dphi: for rho = 0 these are
// the numbers of the table.
struct FreePath {
  double x = 0.0, y = 0.0, angle = 0.0, s = 0.0, travel = 0.0;
};

FreePath free_path(double s, double travel, double rho) {
  constexpr int kSteps = 400'000;
  using State = std::array<double, 4>;
  const auto rate = [rho](const State& q) {
    const double d = std::sqrt(q[3] * q[3] + 0.25) - q[3];
    const double turn = std::cos(q[2]) / (q[3] + d);
    return State{-d * turn * std::sin(q[2]), d * turn * std::cos(q[2]), turn, std::sin(q[2]) - rho * turn};
  };
  State q{0.0, 0.0, 0.0, s};
  const double step = travel / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    if (q[3] >= 0.5) return {q[0], q[1], q[2], q[3], i * step};
    State half = q;
    const State first = rate(q);
    for (std::size_t k = 0; k < 4; ++k) half[k] += 0.5 * step * first[k];
    const State second = rate(half);
    for (std::size_t k = 0; k < 4; ++k) q[k] += step * second[k];
  }
  return {q[0], q[1], q[2], q[3], travel};
}

TEST(Rod, N48AndN49FollowTheFreePathAtAnyRate) {
  const FreePath table = free_path(0.3, 0.5, 0.0);
  EXPECT_NEAR(table.x, -0.0631766278, 1e-6);
  EXPECT_NEAR(table.y, 0.1739242442, 1e-6);
  EXPECT_NEAR(degrees(table.angle), 41.91887332, 1e-4);
  EXPECT_NEAR(table.s, 0.4880805891, 1e-6);
  const FreePath lost = free_path(0.3, 1.0, 0.0);
  EXPECT_NEAR(lost.travel, 0.5176592005, 1e-5);
  EXPECT_NEAR(degrees(lost.angle), 42.98098419, 1e-3);

  const double rho = touch_m() / kLengthM;
  const FreePath expected = free_path(0.3, 0.5, rho);
  RodPlace first;
  for (const double rate_hz : {500.0, 1000.0, 4000.0}) {
    PushedParticles particles = lowered_beside(0.3e-6, thin_setup(), rate_hz);
    // the base is behind the tip by the lever's deflection
    const double bend_m = 0.5 * kThresholdN / 100.0;
    drag(particles, base_at(0.3e-6, (0.5 - rho) * kLengthM + bend_m), 5e-7, rate_hz);
    const RodPlace at = place_of(particles);
    EXPECT_NEAR(at.x, expected.x, 5e-4) << rate_hz;
    EXPECT_NEAR(at.y, expected.y, 5e-4) << rate_hz;
    EXPECT_NEAR(degrees(at.angle), degrees(expected.angle), 0.1) << rate_hz;
    EXPECT_EQ(particles.last().exhausted, 0U) << rate_hz;
    if (rate_hz == 500.0) first = at;
    EXPECT_NEAR(at.angle, first.angle, 1e-5) << rate_hz;
    EXPECT_NEAR(at.y, first.y, 1e-5) << rate_hz;
  }
}

// The tip is kept at the end, across the rod at every moment: the pivot stays where it is.
TEST(Rod, N50TurnsAboutAFixedPointWhenItsEndIsPushed) {
  PushedParticles particles = lowered_beside(0.5e-6 - 2e-9);
  const double pivot = rod_pivot(Length(1.0), Length(0.498)).si, arm = 0.498 + pivot, rho = touch_m() / kLengthM;
  constexpr int kSteps = 4000;
  const double travel = 0.3, turn = travel / arm;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = turn * i / kSteps;  // about the pivot at (-pivot, 0)
    const double x = -pivot + arm * std::cos(angle) + rho * std::sin(angle);
    const double y = arm * std::sin(angle) - rho * std::cos(angle);
    particles.move_to(base_at(x * kLengthM, y * kLengthM), Time(1e-3));
  }
  const RodPlace at = place_of(particles);
  EXPECT_NEAR(degrees(at.angle), degrees(turn), 0.1);
  EXPECT_NEAR(at.y, pivot * std::sin(turn), 1e-3);
  // at the very end, as in the table
  const double end = 0.5 + rod_pivot(Length(1.0), Length(0.5)).si;
  expect_relative(degrees(0.3 / end), 24.30854054, kClosed);
  expect_relative((end - 0.5) * std::sin(0.3 / end), 0.0852555496, kClosed);
}

TEST(Rod, N52HowLongItMayBeToBeRigid) {
  // (M21), with I = pi r^4/4
  const auto rod_lag = [](Stiffness friction_per_length, Pressure modulus, Length radius, Length length) {
    return Length(friction_per_length.si * std::pow(length.si, 4.0) /
                  (128.0 * modulus.si * 0.25 * std::numbers::pi * std::pow(radius.si, 4.0)));
  };
  expect_relative(rod_lag(Stiffness(0.05), Pressure(1e12), 10_nm, Length(1e-6)).si, 4.973591972e-08, kClosed);
  const Length longest = longest_rigid_rod(Stiffness(0.05), Pressure(1e12), 10_nm);
  expect_relative(longest.si, 7.381080595e-07, kClosed);
  expect_relative(rod_lag(Stiffness(0.05), Pressure(1e12), 10_nm, longest) / longest, kRigidShare, 1e-12);
}

TEST(Rod, N71TheDistanceOfItsEndsFromThoseWanted) {
  const double angle = 7.0 * std::numbers::pi / 180.0;
  const std::vector<Sideways<Length>> wanted{{}}, there{{Length(0.0), 40_nm}};
  const std::vector<Sideways<double>> axis{{1.0, 0.0}};
  for (const double way_round : {1.0, -1.0}) {
    const Sideways<Length> end{Length(way_round * 0.5e-6 * std::cos(angle)),
                               Length(way_round * 0.5e-6 * std::sin(angle))};
    expect_relative(match_pattern(wanted, there, {axis, std::vector{end}}).rms.si, 72.98578067e-9, 1e-9);
  }
}

TEST(Rod, N85TheFrictionOfAnyMotion) {
  expect_relative(mean_way({0.3, 0.5, 1.0}).way, 0.7274418591, kClosed);
  expect_relative(mean_way({0.001, 0.5, 1.0}).way, 0.6250039785, kClosed);
  EXPECT_EQ(mean_way({}).way, 0.0);
}

TEST(Rod, TheGradientOfItsFrictionIsThatOfItsWayAndItsLoadDrivesIt) {
  for (const double end : {-0.9, -0.04, 0.0, 1e-9, 0.06, 0.4, 3.0}) {
    for (const double along : {-0.7, 0.0, 1e-6, 0.2}) {
      const RodVector motion{along, 0.31, end};
      const MeanWay at = mean_way(motion);
      const RodMatrix curvature = mean_way_curvature(motion);
      for (std::size_t i = 0; i < 3; ++i) {
        constexpr double kStep = 1e-7;
        RodVector more = motion, less = motion;
        more[i] += kStep;
        less[i] -= kStep;
        EXPECT_NEAR((mean_way(more).way - mean_way(less).way) / (2.0 * kStep), at.slope[i], 2e-7);
        if (along == 0.0 || along == 1e-6) continue;  // steep there
        for (std::size_t j = 0; j < 3; ++j) {
          EXPECT_NEAR((mean_way(more).slope[j] - mean_way(less).slope[j]) / (2.0 * kStep), curvature[i][j], 1e-5);
        }
      }
      // a load on the limit surface drives the motion that it belongs to
      const DrivenMotion driven = driven_motion(at.slope);
      EXPECT_NEAR(driven.force, 1.0, 1e-9) << along << " " << end;
    }
  }
  EXPECT_EQ(driven_motion({}).force, 0.0);
}

TEST(Rod, GivesAtItsThresholdAndGoesOnWithTheKineticOne) {
  for (const double s : {0.0, 0.2, 0.45}) {
    PushedParticles particles = lowered_beside(s * kLengthM, thin_setup(0.5));
    const double expected_n = rod_threshold(Force(kThresholdN), Length(1.0), Length(s)).si;
    double most_n = 0.0;
    const double from_m = -touch_m() - 1e-10;
    drag(particles, base_at(s * kLengthM, from_m), 1e-7, 1000.0);
    for (int i = 0; i < 2000 && particles.last().yields == 0; ++i) {
      most_n = std::max(most_n, magnitude(particles.last().lateral).si);
      particles.move_to(base_at(s * kLengthM, from_m + i * 1e-13), Time(1e-3));
    }
    ASSERT_EQ(particles.last().yields, 1U) << s;
    EXPECT_NEAR(most_n, expected_n, 0.02 * expected_n) << s;
    EXPECT_LE(most_n, expected_n * (1.0 + 1e-9)) << s;
    expect_relative(particles.last().gave_at.si, expected_n, 1e-4);
    drag(particles, base_at(s * kLengthM, from_m + 2e-9), 1e-8, 1000.0);
    expect_relative(magnitude(particles.last().lateral).si, 0.5 * expected_n, 2e-2);
    EXPECT_EQ(particles.last().state, PushState::Slides);
  }
}

TEST(Rod, PushesASphereAndAnotherRod) {
  PushSetup setup{flank_tip(10_nm), {10_N_per_m, 10_N_per_m, 100_N_per_m}, 0.0, {}};
  ParticleSpecies rod = rod_species();
  rod.contact.tip_radius = 25_nm;
  rod.length = 300_nm;
  setup.species = {rod, test::constant(Force(0.3e-9))};
  const std::vector<PlacedParticle> placed{{.species = 0, .position = {}},
                                           {.species = 1, .position = {Length(60e-9), Length(60e-9)}},
                                           {.species = 0, .position = {Length(-170e-9), Length(60e-9)}}};
  PushedParticles particles(setup, placed, base_at(0.0, -100e-9, 60e-9));
  drag(particles, base_at(0.0, -100e-9), 1e-6, 1000.0);
  drag(particles, base_at(0.0, 120e-9), 1e-7, 1000.0);
  EXPECT_GT(particles.position(1).y, 120_nm);
  EXPECT_GT(magnitude(particles.position(2) - placed[2].position), 20_nm);
  EXPECT_EQ(particles.turn(1), HalfTurn{});
  // no particle overlaps another by more than the contacts allow
  EXPECT_GT(magnitude(particles.position(1) - particles.nearest(0, particles.position(1))), 49_nm);
}

TEST(Rod, IsTheSameBitForBitWheneverItIsPutWhereItWas) {
  const auto run = [](PushedParticles& particles) {
    particles.hold_over(base_at(0.3e-6, -20e-9, 10e-9));
    drag(particles, base_at(0.3e-6, -20e-9), 1e-7, 1000.0);
    drag(particles, base_at(0.2e-6, 0.1e-6), 1e-6, 1000.0);
    return std::array{particles.position(0).x.si, particles.position(0).y.si,    particles.turn(0).w,
                      particles.turn(0).z,        particles.last().lateral.x.si, particles.last().lateral.y.si};
  };
  PushedParticles first = lowered_beside(-0.1e-6);
  drag(first, base_at(-0.1e-6, 0.1e-6), 1e-6, 1000.0);
  const ParticlePlace there{first.position(0), first.turn(0)};
  PushedParticles second(thin_setup(), {{.species = 0, .position = {}}}, base_at(0.0, -1e-6, 10e-9));
  second.put({there}, base_at(0.0, -1e-6, 10e-9));
  EXPECT_EQ(run(first), run(second));
}

TEST(Rod, RefusesWhatCannotBe) {
  PushSetup setup = thin_setup();
  setup.species[0].law = ParticleLaw::ContactArea;
  EXPECT_THROW(validate(setup), UnphysicalValue);
  setup = thin_setup();
  setup.species[0].length = Length(1e-9);  // less than its radius
  EXPECT_THROW(validate(setup), UnphysicalValue);
  setup.species[0].length = Length(std::nan(""));
  EXPECT_THROW(validate(setup), std::invalid_argument);
  setup = thin_setup();
  const auto overlap = [&](double x_m, double y_m, double angle) {
    validate(setup, {{.species = 0, .position = {}},
                     {.species = 0, .position = {Length(x_m), Length(y_m)}, .angle_rad = angle}});
  };
  EXPECT_THROW(overlap(0.0, 0.3e-6, 1.5), std::invalid_argument) << "they cross";
  EXPECT_THROW(overlap(0.0, 3e-9, 0.0), std::invalid_argument) << "side by side";
  EXPECT_THROW(overlap(1.002e-6, 0.0, 0.0), std::invalid_argument) << "end to end";
  EXPECT_THROW(overlap(0.0, 1e-6, std::nan("")), std::invalid_argument);
  EXPECT_NO_THROW(overlap(0.0, 5e-9, 0.0));
  PushedParticles particles(setup, {{.species = 0, .position = {}}}, base_at(0.0, 0.0, 10e-9));
  EXPECT_THROW(particles.put({{{}, {0.5, 0.5}}}, base_at(0.0, 0.0, 10e-9)), std::invalid_argument);
}

}  // namespace rod_test
}  // namespace afm::physics
