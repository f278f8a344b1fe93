// SPDX-License-Identifier: Apache-2.0
// Spheres that stick to the tip: held, dragged, torn off.
// Invariant: no path of the hand gains energy from adhesion between tip and particles
#include "physics/manipulation/tip_hold.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "physics/contact_parameters.h"
#include "physics/manipulation/pushed_particles.h"
#include "pushing.h"
#include "support/deep.h"
#include "support/no_alloc.h"

namespace afm::physics {
namespace tip_hold_test {

using std::numbers::pi;
using test::base_at;
using test::drag;
using test::expect_relative;
using test::flank_tip;
using test::gold;
using test::latex;

const double kSine = std::sin(pi / 12.0), kCosine = std::cos(pi / 12.0);
const PushSprings kSprings{Stiffness(10.0), Stiffness(1.0), Stiffness(100.0)};  // springs of row N27
constexpr double kHeight = 10e-9;                                               // height of an apex whose flank touches

// Gold of row N55 that moves steadily once it has given.
ParticleSpecies sticky_gold(double shear_pa = 10e6) {
  ParticleSpecies species = gold();
  species.tip_adhesion = SurfaceEnergy(0.05);
  species.shear_strength = Pressure(shear_pa);
  species.ageing = Time(1.0);
  species.sticks = true;
  return species;
}

PushSetup setup_of(const ParticleSpecies& species) { return {flank_tip(Length(10e-9)), kSprings, 0.0, {species}}; }

double touch_m(const PushSetup& setup, double height_m = kHeight) {
  return side_contact(setup.tip, setup.species.front().contact.tip_radius, Length(height_m)).distance.si;
}

// ---- rows of the table of cases

TEST(TipHold, N54TheAdhesionThatLifts) {
  const double radius[] = {5e-9, 25e-9, 50e-9}, ratio[] = {1.5, 3.5, 6.0};
  for (int i = 0; i < 3; ++i) {
    ParticleSpecies species = gold();
    species.contact.tip_radius = Length(radius[i]);
    const SphereCone tip = flank_tip(Length(10e-9));
    const SurfaceEnergy least = lifting_adhesion(tip, species);
    expect_relative(least / species.contact.work_of_adhesion, ratio[i], 1e-9);
    species.tip_adhesion = 0.999 * least;
    EXPECT_FALSE(lifts(tip, species));
    species.tip_adhesion = 1.001 * least;
    EXPECT_TRUE(lifts(tip, species));
  }
}

TEST(TipHold, N55TheSidewaysPullAndWhetherItDrags) {
  const SphereCone tip = flank_tip(Length(10e-9));
  expect_relative(tip_pull_off(tip, sticky_gold(), true).si * kCosine, 3.598997214e-09, 1e-6);
  EXPECT_TRUE(follows_tip(tip, sticky_gold()));
  EXPECT_FALSE(follows_tip(tip, sticky_gold(200e6)));
  // the border is where the pull is the threshold of the lifted sphere
  ParticleSpecies border = sticky_gold();
  const Force pull = tip_pull_off(tip, border, true);
  border.shear_strength = border.shear_strength * (pull * kCosine / threshold_under_pull(border, pull * kSine));
  ParticleSpecies weaker = border;
  weaker.shear_strength = 1.001 * border.shear_strength;
  border.shear_strength = 0.999 * border.shear_strength;
  EXPECT_TRUE(follows_tip(tip, border));
  EXPECT_FALSE(follows_tip(tip, weaker));
}

TEST(TipHold, N56TheLossOfATear) {
  const Stiffness spring = stiffness_along_normal(kSprings, kSine, kCosine);
  expect_relative(tear_energy(tip_pull_off(flank_tip(Length(10e-9)), sticky_gold(), true), spring).si, 1.182036707e-18,
                  1e-6);
}

TEST(TipHold, N58TheScatterThatReplays) {
  const double u[] = {0.6093945246, 0.4377560047, 0.7901067744}, factor[] = {1.036187654, 0.9499630367, 1.151837344};
  const std::uint64_t particle[] = {0, 1, 1}, count[] = {0, 0, 1};
  double mean = 0.0;
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(scatter_number(7, particle[i], count[i]), u[i], 5e-11);
    expect_relative(pull_off_factor(7, particle[i], count[i]), factor[i], 1e-9);
  }
  for (std::uint64_t i = 0; i < 10'000; ++i) mean += pull_off_factor(3, i, 0) / 10'000.0;
  EXPECT_NEAR(mean, 1.0, 0.01);
}

TEST(TipHold, ASphereThatIsPulledUpGivesEarlierAndLosesItsHold) {
  const ParticleSpecies species = gold();
  EXPECT_LT(threshold_under_pull(species, Force(5e-9)), sliding_threshold(species, Force(0.0)));
  EXPECT_TRUE(std::isfinite(threshold_under_pull(species, 2.0 * pull_off_force(species)).si));
  ParticleSpecies loaded = species;
  loaded.law = ParticleLaw::Amontons;
  loaded.coefficient = 0.3;
  EXPECT_NEAR(threshold_under_pull(loaded, pull_off_force(species)).si, 0.0, 1e-16);
}

TEST(TipHold, RefusesWhatIsNotModelled) {
  PushSetup setup = setup_of(sticky_gold());
  EXPECT_NO_THROW(validate(setup));
  setup.springs.contact = Stiffness(1.0);
  EXPECT_THROW(validate(setup), UnphysicalValue) << "the contact would stretch too far";
  setup = setup_of(sticky_gold());
  setup.species.front().tip_adhesion = SurfaceEnergy(0.0);
  EXPECT_THROW(validate(setup), UnphysicalValue) << "nothing holds";
}

// ---- paths, at the rates of a servo

class HoldAtRate : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Holding, HoldAtRate, testing::Values(500.0, 1000.0, 4000.0));

TEST_P(HoldAtRate, N55ATipThatGoesAwayDragsTheSphere) {
  const PushSetup setup = setup_of(sticky_gold());
  const double rho = touch_m(setup);
  PushedParticles particles(setup, {{0, {Length(rho), Length(0.0)}}}, base_at(0.0, 0.0, kHeight));
  drag(particles, base_at(0.03e-9, 0.0, kHeight), 1e-8, GetParam());
  EXPECT_EQ(particles.last().attached, 1U);
  drag(particles, base_at(-30e-9, 0.0, kHeight), 1e-8, GetParam());
  const PushTick& tick = particles.last();
  EXPECT_EQ(tick.torn, 0U);
  EXPECT_EQ(tick.dragged, 1U);
  // at rest the contact holds f_s(-N sin)
  double held = 0.0;
  for (int i = 0; i < 50; ++i) held = threshold_under_pull(setup.species.front(), Force(held * kSine)).si / kCosine;
  expect_relative(tick.dragged_at.si, held * kCosine, 1e-2);
  EXPECT_EQ(tick.state, PushState::Slides);
  // N cos = f_k(-N sin), and the places that follow from it
  double pull = 0.0;
  for (int i = 0; i < 50; ++i) {
    pull = 0.5 * threshold_under_pull(setup.species.front(), Force(pull * kSine)).si / kCosine;
  }
  expect_relative(-tick.normal.si, pull, 1e-5);
  expect_relative(tick.lateral.x.si, pull * kCosine, 1e-5);
  expect_relative(-tick.lift.si, pull * kSine, 1e-5);
  const double apex_m = -30e-9 + pull * kCosine / 10.0, height_m = kHeight - pull * kSine / 1.0;
  const double expected_m = apex_m + touch_m(setup, height_m) + pull / (100.0 * kCosine);
  EXPECT_NEAR(particles.position(0).x.si, expected_m, 1e-4 * rho);
  EXPECT_NEAR(particles.position(0).y.si, 0.0, 1e-4 * rho);
}

TEST_P(HoldAtRate, N56AContactThatASphereResistsTearsAtItsPullOff) {
  for (const bool pinned : {true, false}) {
    const PushSetup setup = setup_of(sticky_gold(200e6));
    PushedParticles particles(setup, {{0, {Length(touch_m(setup) - 0.01e-9), Length(0.0)}, pinned}},
                              base_at(0.0, 0.0, kHeight));
    const double pull_off = tip_pull_off(setup.tip, setup.species.front(), true).si;
    const double step_m = 1e-9 / GetParam();
    double most = 0.0, at_m = 0.0;
    while (particles.last().torn == 0) {
      most = std::max(most, -particles.last().normal.si);
      particles.move_to(base_at(at_m -= step_m, 0.0, kHeight), Time(1.0 / GetParam()));
      ASSERT_GT(at_m, -2e-9);
    }
    const PushTick& tick = particles.last();
    EXPECT_LE(most, pull_off);
    EXPECT_GT(most, pull_off - 10.0 * step_m);
    expect_relative(tick.torn_at.si, pull_off, 1e-12);
    expect_relative(tick.torn_lost.si, 1.182036707e-18, 1e-6);
    // released at once: no force, no stored energy, and all work of the hand is lost
    EXPECT_EQ(tick.particle, kNoParticle);
    EXPECT_NEAR(magnitude(tick.lateral).si, 0.0, 1e-18);
    EXPECT_NEAR(tick.lift.si, 0.0, 1e-18);
    EXPECT_NEAR(tick.stored.si, 0.0, 1e-30);
    EXPECT_GE(tick.lost.si, tick.torn_lost.si * (1.0 - 1e-9));
    EXPECT_LE(tick.lost.si, tick.torn_lost.si * 1.02);
    EXPECT_GE(tick.work.si, tick.torn_lost.si * 0.98);
    EXPECT_EQ(tick.dragged, 0U);
    EXPECT_EQ(tick.exhausted, 0U);
    EXPECT_EQ(particles.position(0).x.si, touch_m(setup) - 0.01e-9);
  }
}

TEST_P(HoldAtRate, ALiftDrawsTheSphereUnderTheTipAndTearsThere) {
  const PushSetup setup = setup_of(sticky_gold());
  PushedParticles particles(setup, {{0, {Length(touch_m(setup) - 0.01e-9), Length(0.0)}}}, base_at(0.0, 0.0, kHeight));
  drag(particles, base_at(0.0, 0.0, 80e-9), 2e-8, GetParam());
  EXPECT_EQ(particles.last().torn, 1U);
  expect_relative(particles.last().torn_at.si, tip_pull_off(setup.tip, setup.species.front(), false).si, 1e-12);
  EXPECT_LT(std::abs(particles.position(0).x.si), 0.15 * 35e-9);
  EXPECT_EQ(magnitude(particles.last().lateral).si, 0.0);
}

// ---- properties

TEST(TipHold, APushIsThatOfATipThatDoesNotStick) {
  ParticleSpecies plain = sticky_gold();
  plain.sticks = false;
  PushSetup with = setup_of(sticky_gold()), without = setup_of(plain);
  with.tip_friction = without.tip_friction = 0.3;
  const std::vector<PlacedParticle> placed{{0, {Length(touch_m(with) + 1e-9), Length(1e-9)}}};
  PushedParticles sticky(with, placed, base_at(0.0, 0.0, kHeight)), free(without, placed, base_at(0.0, 0.0, kHeight));
  for (int i = 1; i <= 600; ++i) {
    const PushTick &a = sticky.move_to(base_at(0.05e-9 * i, 0.0, kHeight), Time(1e-3)),
                   &b = free.move_to(base_at(0.05e-9 * i, 0.0, kHeight), Time(1e-3));
    ASSERT_EQ(std::memcmp(&a.lateral, &b.lateral, sizeof a.lateral), 0) << i;
    ASSERT_EQ(sticky.position(0).x.si, free.position(0).x.si) << i;
    ASSERT_EQ(sticky.position(0).y.si, free.position(0).y.si) << i;
  }
  EXPECT_EQ(sticky.last().attached, 1U);
  EXPECT_EQ(free.last().attached, 0U);
  EXPECT_GT(free.position(0).x.si, touch_m(with) + 20e-9);
}

TEST(TipHold, EachContactHasItsOwnPullOff) {
  ParticleSpecies species = sticky_gold();
  species.scatter_seed = 7;
  const PushSetup setup = setup_of(species);
  const double pull_off = tip_pull_off(setup.tip, species, true).si;
  PushedParticles particles(setup, {{0, {Length(touch_m(setup) + 1e-9), Length(0.0)}, true}},
                            base_at(0.0, 0.0, kHeight));
  for (std::uint64_t contact = 0; contact < 3; ++contact) {
    drag(particles, base_at(1.1e-9, 0.0, kHeight), 1e-8, 1000.0);
    drag(particles, base_at(0.0, 0.0, kHeight), 1e-8, 1000.0);
    EXPECT_EQ(particles.last().torn, contact + 1);
    expect_relative(particles.last().torn_at.si, pull_off * pull_off_factor(7, 0, contact), 1e-12);
  }
  // the sequel to a lift depends only on the places
  particles.hold_over(base_at(0.0, 0.0, 100e-9));
  drag(particles, base_at(0.0, 0.0, kHeight), 1e-7, 1000.0);
  drag(particles, base_at(1.1e-9, 0.0, kHeight), 1e-8, 1000.0);
  drag(particles, base_at(0.0, 0.0, kHeight), 1e-8, 1000.0);
  expect_relative(particles.last().torn_at.si, pull_off * pull_off_factor(7, 0, 0), 1e-12);
}

TEST(TipHold, ATickThatTearsDoesNotAllocate) {
  const PushSetup setup = setup_of(sticky_gold(200e6));
  PushedParticles particles(setup, {{0, {Length(touch_m(setup) - 0.01e-9), Length(0.0)}}}, base_at(0.0, 0.0, kHeight));
  {
    const afm::test::NoAllocation none;
    for (int i = 1; i <= 100; ++i) particles.move_to(base_at(-0.02e-9 * i, 0.0, kHeight), Time(1e-3));
  }
  EXPECT_EQ(particles.last().torn, 1U);
}

struct Counted {
  std::uint64_t attached = 0, dragged = 0, torn = 0;
};

// Expects the certificate in every tick of a path of 10^4 ticks among spheres that stick, with lifts.
void expect_certified(std::uint64_t seed, int spheres, Counted& counted) {
  constexpr double kRounding = 1e-12, kPlaceRounding = 1e-21;
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  const auto spring = [&](double low, double high) {
    return Stiffness(std::exp(uniform(std::log(low), std::log(high))));
  };
  PushSetup setup{flank_tip(Length(uniform(5e-9, 20e-9)), uniform(0.0, 30.0)),
                  {spring(0.3, 100.0), spring(0.05, 40.0), spring(10.0, 1000.0)},
                  uniform(0.0, 0.5),
                  {gold(), latex()}};
  for (ParticleSpecies& species : setup.species) {
    species.kinetic_ratio = uniform(0.2, 1.0);
    species.ageing = Time(uniform(0.0, 1.0) < 0.3 ? 0.0 : 0.1);
    species.law = static_cast<ParticleLaw>(std::uniform_int_distribution(0, 2)(random));
    species.coefficient = uniform(0.05, 0.5);
    species.shear_strength = Pressure(std::exp(uniform(std::log(1e6), std::log(3e8))));
    species.tip_adhesion = SurfaceEnergy(uniform(0.001, 0.15));
    species.scatter_seed = static_cast<std::uint16_t>(std::uniform_int_distribution(0, 2)(random));
    species.sticks = true;
  }
  std::vector<PlacedParticle> placed;
  const int side = static_cast<int>(std::ceil(std::sqrt(spheres)));
  for (int i = 0; i < spheres; ++i) {
    placed.push_back({std::uniform_int_distribution<std::size_t>(0, 1)(random),
                      {Length(110e-9 * (i % side) + 60e-9), Length(110e-9 * (i / side))},
                      std::uniform_int_distribution(0, 9)(random) == 0});
  }
  PushedParticles particles(setup, placed, base_at(0.0, 0.0, 150e-9));
  double before = 0.0, largest = 0.0, strongest = 0.0, x = 0.0, y = 0.0, z = 150e-9, dx = 0.0, dy = 0.0, dz = 0.0;
  for (int i = 0; i < 10'000; ++i) {
    if (i % 40 == 0) {  // to and fro about one of the spheres, at times up or down
      const auto to = particles.position(static_cast<std::size_t>(i / 4000) % particles.size());
      const double ticks = std::exp(uniform(std::log(40.0), std::log(1000.0)));
      dx = (to.x.si + uniform(-90e-9, 90e-9) - x) / ticks;
      dy = (to.y.si + uniform(-90e-9, 90e-9) - y) / ticks;
      dz = uniform(0.0, 1.0) < 0.4 ? (uniform(-10e-9, 130e-9) - z) / 40.0 : 0.0;
    }
    const PushTick& tick = particles.move_to(base_at(x += dx, y += dy, z += dz), Time(1e-3));
    const double surplus = (tick.given - tick.lost - tick.stored).si;
    largest = std::max({largest, std::abs(tick.given.si), tick.lost.si, tick.stored.si});
    strongest = std::max({strongest, std::abs(tick.normal.si), magnitude(tick.lateral).si});
    ASSERT_GE(surplus - before, -kRounding * largest - kPlaceRounding * strongest) << "seed " << seed << ", tick " << i;
    before = surplus;
    if (spheres > 1) continue;
    // the published stored energy is the actual one
    const auto square = [](double value) { return value * value; };
    const double lever = 0.5 * (square(magnitude(tick.lateral).si) / setup.springs.lateral.si +
                                square(tick.lift.si) / setup.springs.normal.si);
    ASSERT_NEAR(tick.stored.si, lever + 0.5 * square(tick.normal.si) / setup.springs.contact.si,
                1e-9 * largest + kPlaceRounding * strongest)
        << "seed " << seed << ", tick " << i;
  }
  counted.attached += particles.last().attached;
  counted.dragged += particles.last().dragged;
  counted.torn += particles.last().torn;
}

TEST(Certificate, HoldsAmongSpheresThatStickToTheTip) {
  const int paths = support::deep() ? 300 : 5;
  std::uint64_t seed = 1;
  for (const int spheres : {1, 9}) {
    Counted counted;
    for (int i = 0; i < paths; ++i) {
      expect_certified(seed++, spheres, counted);
      if (HasFatalFailure()) return;
    }
    const auto least = static_cast<std::uint64_t>(2 * paths);
    EXPECT_GT(counted.attached, least) << spheres;
    EXPECT_GT(counted.dragged, least) << spheres;
    EXPECT_GT(counted.torn, least) << spheres;
  }
}

}  // namespace tip_hold_test
}  // namespace afm::physics
