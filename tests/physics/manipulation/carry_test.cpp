// SPDX-License-Identifier: Apache-2.0
// Spheres that the tip lifts off the sample, carries and sets down.
// Invariant: no path of the hand gains energy from particles that it lifts, carries and sets down
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "physics/contact_parameters.h"
#include "physics/manipulation/pushed_particles.h"
#include "physics/manipulation/tip_hold.h"
#include "physics/manipulation/tip_meeting.h"
#include "pushing.h"
#include "support/deep.h"
#include "support/no_alloc.h"

namespace afm::physics {
namespace carry_test {

using test::base_at;
using test::drag;
using test::expect_relative;
using test::flank_tip;
using test::gold;
using test::latex;

const PushSprings kSprings{Stiffness(10.0), Stiffness(1.0), Stiffness(100.0)};
constexpr double kRadius = 15e-9;

// Gold of 30 nm that a tip of 40 nm lifts off the sample, and a pad that keeps it.
ParticleSpecies small_gold() {
  ParticleSpecies species = gold();
  species.contact.tip_radius = Length(kRadius);
  species.contact.work_of_adhesion = SurfaceEnergy(0.02);
  species.law = ParticleLaw::Amontons;
  species.coefficient = 0.3;
  species.rolling_distance = Length(0.0);
  species.tip_adhesion = SurfaceEnergy(0.06);
  species.sticks = true;
  return species;
}

PushSetup setup_of(const ParticleSpecies& species) { return {flank_tip(Length(20e-9)), kSprings, 0.0, {species}, {}}; }

StickyPad pad_at(double x_m, double y_m, double work = 0.2) {
  return {{Length(x_m), Length(y_m)}, {Length(40e-9), Length(40e-9)}, SurfaceEnergy(work)};
}

constexpr double kAside = 45e-9;  // distance from the sphere at which no tip touches it
constexpr double kOver = 100e-9;

// Touches the sphere at (0, 0) from the side and rises.
void pick_up(PushedParticles& particles, double rate_hz) {
  drag(particles, base_at(-kAside, 0.0, 10e-9), 1e-6, rate_hz);
  drag(particles, base_at(-28e-9, 0.0, 10e-9), 5e-8, rate_hz);
  drag(particles, base_at(-28e-9, 0.0, kOver), 5e-8, rate_hz);
}

class CarryAtRate : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Carrying, CarryAtRate, testing::Values(500.0, 1000.0, 4000.0));

TEST_P(CarryAtRate, N54ATipThatRisesFromTheTopLiftsAtTheRatio) {
  const double radius[] = {5e-9, 25e-9, 50e-9}, ratio[] = {1.5, 3.5, 6.0};
  for (int i = 0; i < 3; ++i) {
    for (const double share : {0.999, 1.001}) {
      ParticleSpecies species = gold();
      species.contact.tip_radius = Length(radius[i]);
      species.rolling_distance = Length(0.0);
      species.tip_adhesion = share * ratio[i] * species.contact.work_of_adhesion;
      species.sticks = true;
      const PushSetup setup{flank_tip(Length(10e-9)), kSprings, 0.0, {species}, {}};
      const double top_m = 2.0 * radius[i];
      PushedParticles particles(setup, {{0, {Length(0.0), Length(0.0)}}}, base_at(0.0, 0.0, top_m + 1e-9));
      drag(particles, base_at(0.0, 0.0, top_m - 0.2e-9), 2e-8, GetParam());
      drag(particles, base_at(0.0, 0.0, top_m + 60e-9), 5e-8, GetParam());
      const PushTick& tick = particles.last();
      EXPECT_EQ(tick.attached, 1U);
      EXPECT_EQ(tick.lifted, share > 1.0 ? 1U : 0U) << i;
      EXPECT_EQ(tick.torn, share > 1.0 ? 0U : 1U) << i;
      EXPECT_EQ(tick.state, share > 1.0 ? PushState::Carried : PushState::Free);
      if (share > 1.0) expect_relative(tick.lifted_at.si, pull_off_force(species).si, 1e-12);
    }
  }
}

TEST_P(CarryAtRate, ASphereIsLiftedCarriedAndSetDownOnAPad) {
  PushSetup setup = setup_of(small_gold());
  setup.pads = {pad_at(200e-9, 60e-9)};
  PushedParticles particles(setup, {{0, {Length(0.0), Length(0.0)}}}, base_at(-kAside, 0.0, kOver));
  pick_up(particles, GetParam());
  const PushTick& tick = particles.last();
  EXPECT_EQ(tick.lifted, 1U);
  expect_relative(tick.lifted_at.si, 1.5 * std::numbers::pi * 0.02 * kRadius, 1e-9);
  EXPECT_EQ(tick.state, PushState::Carried);
  EXPECT_EQ(tick.particle, 0U);
  // a sphere without weight: the lever feels no pull, nothing is stored, and the pull's energy is lost
  EXPECT_EQ(magnitude(tick.lateral).si, 0.0);
  EXPECT_EQ(tick.lift.si, 0.0);
  EXPECT_NEAR(tick.stored.si, 0.0, 1e-30);
  EXPECT_GT(tick.lost.si, tear_energy(tick.lifted_at, stiffness_along_normal(kSprings, 1.0, 0.0)).si);
  EXPECT_GT(tick.work.si, tick.lost.si);

  const double given_j = tick.given.si;
  const Sideways<Length> before = particles.position(0), from = tick.base.position;
  drag(particles, base_at(200e-9, 60e-9, kOver), 1e-6, GetParam());
  const Sideways<Length> way = tick.base.position - from;
  EXPECT_NEAR((particles.position(0).x - before.x - way.x).si, 0.0, 1e-20);
  EXPECT_NEAR((particles.position(0).y - before.y - way.y).si, 0.0, 1e-20);
  EXPECT_NEAR(tick.given.si, given_j, 1e-9 * given_j) << "a sphere that hangs costs nothing";
  const double work_j = tick.work.si;
  drag(particles, base_at(200e-9, 60e-9, 2.0 * kRadius - 1e-9), 1e-7, GetParam());
  EXPECT_EQ(tick.set_down, 1U);
  EXPECT_EQ(tick.state, PushState::Holds);
  EXPECT_GT(tick.work.si, work_j) << "the lever presses";
  EXPECT_GT(tick.lift.si, 0.0);

  drag(particles, base_at(200e-9, 60e-9, kOver), 1e-7, GetParam());
  EXPECT_EQ(tick.lifted, 1U);
  EXPECT_EQ(tick.torn, 1U);
  expect_relative(tick.torn_at.si, tip_pull_off(setup.tip, setup.species.front(), false).si, 1e-12);
  EXPECT_EQ(tick.state, PushState::Free);
  EXPECT_NEAR(particles.position(0).x.si, 200e-9, 3e-9);
  EXPECT_NEAR(particles.position(0).y.si, 60e-9, 3e-9);
}

TEST(Carry, BesideThePadItIsLiftedAgain) {
  PushSetup setup = setup_of(small_gold());
  setup.pads = {pad_at(200e-9, 60e-9)};
  PushedParticles particles(setup, {{0, {Length(0.0), Length(0.0)}}}, base_at(-kAside, 0.0, kOver));
  pick_up(particles, 1000.0);
  drag(particles, base_at(200e-9, -60e-9, kOver), 1e-6, 1000.0);
  drag(particles, base_at(200e-9, -60e-9, 2.0 * kRadius - 1e-9), 1e-7, 1000.0);
  EXPECT_EQ(particles.last().set_down, 1U);
  drag(particles, base_at(200e-9, -60e-9, kOver), 1e-7, 1000.0);
  EXPECT_EQ(particles.last().lifted, 2U);
  EXPECT_EQ(particles.last().torn, 0U);
  EXPECT_EQ(particles.last().state, PushState::Carried);
}

TEST(Carry, WhatStaysBehindIsAnObstacleThatDoesNotMove) {
  PushSetup setup = setup_of(small_gold());
  setup.springs.normal = Stiffness(40.0);  // lever that does not climb
  const std::vector<PlacedParticle> placed{{0, {Length(0.0), Length(0.0)}}, {0, {Length(150e-9), Length(0.0)}}};
  PushedParticles particles(setup, placed, base_at(-kAside, 0.0, kOver));
  pick_up(particles, 1000.0);
  ASSERT_EQ(particles.last().state, PushState::Carried);
  const double hangs_m = particles.position(0).x.si - particles.last().apex.position.x.si;
  // over it
  drag(particles, base_at(150e-9, 0.0, kOver), 1e-6, 1000.0);
  EXPECT_EQ(magnitude(particles.last().lateral).si, 0.0);
  drag(particles, base_at(60e-9, 0.0, kOver), 1e-6, 1000.0);
  // opposite direction, just above the sample: the lever bends by the excess of the path
  drag(particles, base_at(60e-9, 0.0, 32e-9), 1e-6, 1000.0);
  ASSERT_EQ(particles.last().state, PushState::Carried);
  const double touch_m = 150e-9 - 2.0 * kRadius - hangs_m;
  drag(particles, base_at(touch_m + 2e-9, 0.0, 32e-9), 1e-7, 1000.0);
  const PushTick& tick = particles.last();
  EXPECT_NEAR(tick.lateral.x.si, -2e-9 * 10.0 * 100.0 / 110.0, 1.5e-9);
  EXPECT_NEAR(tick.stored.si, 0.5 * 2e-9 * 2e-9 * 10.0 * 100.0 / 110.0, 0.3e-17);
  EXPECT_EQ(particles.position(1).x.si, 150e-9);
  EXPECT_EQ(particles.position(1).y.si, 0.0);
  EXPECT_EQ(tick.state, PushState::Carried);
  drag(particles, base_at(60e-9, 0.0, 32e-9), 1e-7, 1000.0);
  EXPECT_EQ(magnitude(tick.lateral).si, 0.0);
  EXPECT_NEAR(tick.stored.si, 0.0, 1e-28);
}

TEST(Carry, AHandThatLetsGoLeavesTheSphereWhereItWasLifted) {
  PushedParticles particles(setup_of(small_gold()), {{0, {Length(0.0), Length(0.0)}}}, base_at(-kAside, 0.0, kOver));
  pick_up(particles, 1000.0);
  // the tip has drawn it below itself before it rose
  EXPECT_EQ(particles.last().state, PushState::Carried);
  const double apart_m = std::abs(particles.position(0).x.si - particles.last().apex.position.x.si);
  EXPECT_LT(apart_m, 2e-9);
  drag(particles, base_at(300e-9, 0.0, kOver), 1e-6, 1000.0);
  particles.hold_over(base_at(300e-9, 0.0, kOver));
  EXPECT_EQ(particles.last().state, PushState::Free);
  EXPECT_EQ(particles.last().stored.si, 0.0);
  EXPECT_NEAR(particles.position(0).x.si, -28e-9, 2e-9);
  drag(particles, base_at(400e-9, 0.0, kOver), 1e-6, 1000.0);
  EXPECT_NEAR(particles.position(0).x.si, -28e-9, 2e-9) << "it does not follow";
}

TEST(Carry, APinnedSphereIsNotLifted) {
  PushedParticles particles(setup_of(small_gold()), {{0, {Length(0.0), Length(0.0)}, true}}, base_at(0.0, 0.0, kOver));
  drag(particles, base_at(0.0, 0.0, 29.8e-9), 1e-7, 1000.0);
  drag(particles, base_at(0.0, 0.0, kOver), 1e-7, 1000.0);
  EXPECT_EQ(particles.last().lifted, 0U);
  EXPECT_EQ(particles.last().torn, 1U);
  EXPECT_EQ(particles.position(0).x.si, 0.0);
}

TEST(Carry, ScatterLiftsNoSphereOfASpeciesThatIsTornOff) {
  ParticleSpecies species = small_gold();
  species.scatter_seed = 7;
  species.tip_adhesion = 0.97 * lifting_adhesion(flank_tip(Length(20e-9)), species);
  const PushSetup setup = setup_of(species);
  PushedParticles particles(setup, {{0, {Length(0.0), Length(0.0)}}}, base_at(0.0, 0.0, 35e-9));
  double strongest_n = 0.0;
  for (int i = 0; i < 12; ++i) {
    const double x_m = particles.position(0).x.si, y_m = particles.position(0).y.si;
    drag(particles, base_at(x_m, y_m, 29.8e-9), 1e-7, 1000.0);
    drag(particles, base_at(x_m, y_m, 40e-9), 1e-7, 1000.0);
    strongest_n = std::max(strongest_n, particles.last().torn_at.si);
  }
  EXPECT_EQ(particles.last().torn, 12U);
  EXPECT_EQ(particles.last().lifted, 0U);
  EXPECT_GT(strongest_n, pull_off_force(species).si);
}

TEST(Carry, ATipThatSetsASphereDownHasNotRiddenOverIt) {
  PushSetup setup = setup_of(small_gold());
  setup.springs.normal = Stiffness(0.1);
  PushedParticles particles(setup, {{0, {Length(0.0), Length(0.0)}}}, base_at(-kAside, 0.0, kOver));
  TipMeeting meeting(setup);
  meeting.begin(base_at(-kAside, 0.0, kOver));
  std::vector<EventKind> events;
  const auto go = [&](double x_m, double z_m) {
    const LeverBase from = particles.last().base;
    for (int i = 1; i <= 1000; ++i) {
      const double s = i / 1000.0;
      particles.move_to(
          base_at(from.position.x.si + s * (x_m - from.position.x.si), 0.0, from.z.si + s * (z_m - from.z.si)),
          Time(1e-3));
      const TipMeeting::Events met = meeting.follow(particles, true);
      for (const TipMeeting::Event& event : met.all()) events.push_back(event.kind);
    }
  };
  go(-kAside, 10e-9);
  go(-28e-9, 10e-9);
  go(-28e-9, kOver);
  ASSERT_EQ(particles.last().state, PushState::Carried);
  go(100e-9, kOver);
  go(100e-9, 1e-9);  // height below the crest, with a soft lever
  EXPECT_EQ(particles.last().set_down, 1U);
  EXPECT_EQ(std::count(events.begin(), events.end(), EventKind::ParticleTouched), 1);
  EXPECT_EQ(std::count(events.begin(), events.end(), EventKind::ParticleRiddenOver), 0);
}

TEST(Carry, APadHoldsASphereHarder) {
  PushSetup setup = setup_of(small_gold());
  const auto gives_at = [&] {
    PushedParticles particles(setup, {{0, {Length(0.0), Length(0.0)}}}, base_at(-kAside, 0.0, 10e-9));
    drag(particles, base_at(-20e-9, 0.0, 10e-9), 1e-7, 1000.0);
    return particles.last().gave_at.si;
  };
  const double on_sample_n = gives_at();
  setup.pads = {pad_at(30e-9, 0.0, 0.04)};
  expect_relative(gives_at(), 2.0 * on_sample_n, 0.02);
  setup.pads = {pad_at(60e-9, 0.0, 0.04)};  // pad with its edge beside the centre
  EXPECT_EQ(gives_at(), on_sample_n);
}

TEST(Carry, RefusesPadsThatCannotBe) {
  PushSetup setup = setup_of(small_gold());
  setup.pads.assign(kMostStickyPads, pad_at(0.0, 0.0));
  EXPECT_NO_THROW(validate(setup));
  setup.pads.push_back(pad_at(0.0, 0.0));
  EXPECT_THROW(validate(setup), UnphysicalValue);
  setup.pads = {pad_at(0.0, 0.0, 0.0)};
  EXPECT_THROW(validate(setup), UnphysicalValue);
  setup.pads = {pad_at(std::nan(""), 0.0)};
  EXPECT_THROW(validate(setup), UnphysicalValue);
  setup.pads = {pad_at(0.0, 0.0)};
  setup.pads.front().half_size.y = Length(0.0);
  EXPECT_THROW(validate(setup), UnphysicalValue);
}

TEST(Carry, TheHeightOfATouchIsTheInverseOfItsDistance) {
  for (const double radius : {10e-9, 20e-9, 50e-9}) {
    const SphereCone tip = flank_tip(Length(20e-9));
    for (double height = 0.0; height <= 2.0 * radius; height += 0.1 * radius) {
      const Length distance = side_contact(tip, Length(radius), Length(height)).distance;
      EXPECT_NEAR(touching_height(tip, Length(radius), distance).si, height, 1e-9 * radius) << radius;
    }
  }
  EXPECT_EQ(touching_height(flank_tip(Length(20e-9)), Length(15e-9), Length(1e-6)).si, 0.0);
}

TEST(Carry, ATickThatCarriesDoesNotAllocate) {
  PushSetup setup = setup_of(small_gold());
  setup.pads = {pad_at(100e-9, 0.0)};
  PushedParticles particles(setup, {{0, {Length(0.0), Length(0.0)}}, {0, {Length(60e-9), Length(0.0)}}},
                            base_at(-kAside, 0.0, 10e-9));
  {
    const afm::test::NoAllocation none;
    pick_up(particles, 1000.0);
    drag(particles, base_at(100e-9, 0.0, kOver), 1e-6, 1000.0);
    drag(particles, base_at(100e-9, 0.0, 29e-9), 1e-7, 1000.0);
    drag(particles, base_at(100e-9, 0.0, kOver), 1e-7, 1000.0);
  }
  EXPECT_EQ(particles.last().lifted, 1U);
  EXPECT_EQ(particles.last().set_down, 1U);
  EXPECT_EQ(particles.last().torn, 1U);
}

struct Counted {
  std::uint64_t lifted = 0, set_down = 0, torn = 0;
};

// Expects the certificate in every tick of a closed path of 10^4 ticks among spheres that can be lifted, and pads.
void expect_certified(std::uint64_t seed, int spheres, Counted& counted) {
  constexpr double kRounding = 1e-12, kPlaceRounding = 1e-21;
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const auto spring = [&](double low, double high) {
    return Stiffness(std::exp(uniform(std::log(low), std::log(high))));
  };
  PushSetup setup{flank_tip(Length(uniform(20e-9, 40e-9)), uniform(5.0, 30.0)),
                  {spring(0.3, 100.0), spring(0.2, 40.0), spring(20.0, 1000.0)},
                  uniform(0.0, 0.5),
                  {gold(), gold()},
                  {}};
  for (ParticleSpecies& species : setup.species) {
    species.contact.tip_radius = Length(uniform(20e-9, 30e-9));
    species.contact.work_of_adhesion = SurfaceEnergy(uniform(0.01, 0.03));
    species.kinetic_ratio = uniform(0.2, 1.0);
    species.ageing = Time(uniform(0.0, 1.0) < 0.3 ? 0.0 : 0.1);
    species.law = static_cast<ParticleLaw>(std::uniform_int_distribution(0, 2)(random));
    species.coefficient = uniform(0.05, 0.5);
    species.tip_adhesion = SurfaceEnergy(uniform(0.05, 0.12));
    species.scatter_seed = static_cast<std::uint16_t>(std::uniform_int_distribution(0, 2)(random));
    species.sticks = true;
  }
  std::vector<PlacedParticle> placed;
  const int side = static_cast<int>(std::ceil(std::sqrt(spheres)));
  for (int i = 0; i < spheres; ++i) {
    placed.push_back({std::uniform_int_distribution<std::size_t>(0, 1)(random),
                      {Length(75e-9 * (i % side)), Length(75e-9 * (i / side))},
                      std::uniform_int_distribution(0, 9)(random) == 0});
  }
  for (int i = 0; i < 2; ++i) {
    setup.pads.push_back(pad_at(uniform(0.0, 150e-9), uniform(0.0, 150e-9), uniform(0.05, 0.3)));
  }
  const LeverBase start = base_at(0.0, 0.0, 150e-9);
  PushedParticles particles(setup, placed, start);
  double before = 0.0, largest = 0.0, strongest = 0.0, x = 0.0, y = 0.0, z = 150e-9, dx = 0.0, dy = 0.0, dz = 0.0;
  const auto expect_surplus = [&](const LeverBase& to, int i) {
    const PushTick& tick = particles.move_to(to, Time(1e-3));
    const double surplus = (tick.given - tick.lost - tick.stored).si;
    largest = std::max({largest, std::abs(tick.given.si), tick.lost.si, tick.stored.si});
    strongest = std::max({strongest, std::abs(tick.normal.si), magnitude(tick.lateral).si, std::abs(tick.lift.si)});
    ASSERT_GE(surplus - before, -kRounding * largest - kPlaceRounding * strongest) << "seed " << seed << ", tick " << i;
    before = surplus;
    ASSERT_GE(tick.stored.si, -1e-9 * largest - kPlaceRounding * strongest) << "seed " << seed << ", tick " << i;
    if (spheres > 1) return;
    // the published stored energy is the actual one
    const auto square = [](double value) { return value * value; };
    const double lever = 0.5 * (square(magnitude(tick.lateral).si) / setup.springs.lateral.si +
                                square(tick.lift.si) / setup.springs.normal.si);
    ASSERT_NEAR(tick.stored.si, lever + 0.5 * square(tick.normal.si) / setup.springs.contact.si,
                1e-9 * largest + kPlaceRounding * strongest)
        << "seed " << seed << ", tick " << i;
  };
  for (int i = 0; i < 10'000; ++i) {
    if (i % 40 == 0) {  // to and fro about one of the spheres, often up or down
      const auto to = particles.position(static_cast<std::size_t>(i / 2000) % particles.size());
      const double ticks = std::exp(uniform(std::log(40.0), std::log(400.0)));
      dx = (to.x.si + uniform(-50e-9, 50e-9) - x) / ticks;
      dy = (to.y.si + uniform(-50e-9, 50e-9) - y) / ticks;
      dz = uniform(0.0, 1.0) < 0.6 ? (uniform(0.0, 130e-9) - z) / 40.0 : 0.0;
    }
    expect_surplus(base_at(x += dx, y += dy, z += dz), i);
    if (testing::Test::HasFatalFailure()) return;
  }
  for (int i = 1; i <= 2000; ++i) {
    const double left = 1.0 - i / 2000.0;
    expect_surplus(base_at(left * x, left * y, 150e-9 + left * (z - 150e-9)), 10'000 + i);
    if (testing::Test::HasFatalFailure()) return;
  }
  const PushTick& tick = particles.last();
  EXPECT_GE(tick.given.si, tick.lost.si - kRounding * largest) << "a closed path gained energy";
  counted.lifted += tick.lifted;
  counted.set_down += tick.set_down;
  counted.torn += tick.torn;
}

TEST(Certificate, HoldsWhereSpheresAreLiftedAndSetDown) {
  std::uint64_t seed = 1;
  for (const int spheres : {1, 9}) {
    const int paths = !support::deep() ? 3 : spheres == 1 ? 300 : 100;
    Counted counted;
    for (int i = 0; i < paths; ++i) {
      expect_certified(seed++, spheres, counted);
      if (testing::Test::HasFatalFailure()) return;
    }
    const auto least = static_cast<std::uint64_t>(paths);
    EXPECT_GT(counted.lifted, least) << spheres;
    EXPECT_GT(counted.set_down, least) << spheres;
    EXPECT_GT(counted.torn, least) << spheres;
  }
}

}  // namespace carry_test
}  // namespace afm::physics
