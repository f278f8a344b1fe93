// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/pushed_particles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "physics/contact_parameters.h"
#include "pushing.h"
#include "support/no_alloc.h"

namespace afm::physics {
namespace pushed_particles_test {

using std::numbers::pi;
using test::base_at;
using test::constant;
using test::degrees;
using test::drag;
using test::expect_relative;
using test::flank_tip;
using test::gold;
using test::latex;

// Every path is the same at each of the rates of a servo.
class AtRate : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Pushing, AtRate, testing::Values(500.0, 1000.0, 4000.0));

const PushSprings kSprings{Stiffness(10.0), Stiffness(1.0), Stiffness(100.0)};  // springs of row N27

PushSetup setup_of(const ParticleSpecies& species, const SphereCone& tip = flank_tip(Length(10e-9)),
                   const PushSprings& springs = kSprings) {
  return {tip, springs, 0.0, {species}};
}

double lateral(const PushTick& tick) { return magnitude(tick.lateral).si; }

// Distance of the axes at touch, with the apex on the sample.
double touch_m(const PushSetup& setup) {
  return side_contact(setup.tip, setup.species.front().contact.tip_radius, Length(0.0)).distance.si;
}

TEST_P(AtRate, N17LatexSlidesAtItsThreshold) {
  ParticleSpecies species = latex();
  species.kinetic_ratio = 1.0;
  const PushSetup setup = setup_of(species);
  const double rho = touch_m(setup);
  PushedParticles particles(setup, {{0, {Length(rho + 1e-9), Length(0.0)}}}, base_at(0.0));
  drag(particles, base_at(20e-9), 1e-6, GetParam());
  const PushTick& tick = particles.last();
  EXPECT_EQ(tick.state, PushState::Slides);
  expect_relative(tick.normal.si, 3.408954384e-09, 1e-6);
  expect_relative(lateral(tick), 3.29279708e-09, 1e-6);
  expect_relative(tick.lift.si, 8.823023185e-10, 1e-6);
  EXPECT_LT(tick.lateral.x.si, 0.0);  // force against the push
}

TEST_P(AtRate, N20RollsOrSlidesAsTheBalanceHasIt) {
  ParticleSpecies species = gold();
  species.kinetic_ratio = 1.0;
  species.tip_adhesion = SurfaceEnergy(0.05);
  PushSetup setup = setup_of(species);
  setup.tip_friction = 0.3;
  PushedParticles particles(setup, {{0, {Length(touch_m(setup)), Length(0.0)}}}, base_at(0.0));
  drag(particles, base_at(5e-9), 1e-6, GetParam());
  EXPECT_EQ(particles.last().state, PushState::Slides);
  expect_relative(lateral(particles.last()), 2.532730344e-10, 1e-6);
}

TEST_P(AtRate, N28HoldsYieldsAndJumps) {
  ParticleSpecies species = constant(Force(3e-9), 0.5, Length(50e-9));
  species.ageing = Time(1.0);  // time long enough to slide on after the jump
  const PushSetup setup = setup_of(species);
  const double rho = touch_m(setup), travel = 5.475442123e-10;
  PushedParticles particles(setup, {{0, {Length(rho), Length(0.0)}}}, base_at(0.0));
  drag(particles, base_at(travel * (1.0 - 1e-7)), 1e-8, GetParam());
  EXPECT_EQ(particles.last().state, PushState::Holds);
  EXPECT_EQ(particles.position(0).x.si, rho);
  expect_relative(lateral(particles.last()), 3e-9, 1e-6);
  particles.move_to(base_at(travel * (1.0 + 1e-9)), Time(1.0 / GetParam()));
  EXPECT_EQ(particles.last().yields, 1U);
  expect_relative(particles.position(0).x.si - rho, 2.737721061e-10, 1e-6);
  expect_relative(lateral(particles.last()), 1.5e-9, 1e-9);
  expect_relative(particles.last().lost.si, 6.159872388e-19, 1e-6);
}

TEST_P(AtRate, N29TeethOfASawWithAgeingAtOnce) {
  const PushSetup setup = setup_of(constant(Force(3e-9), 0.5, Length(50e-9)));
  PushedParticles particles(setup, {{0, {Length(touch_m(setup)), Length(0.0)}}}, base_at(0.0));
  const double period_m = 0.002737721061 * 100e-9, first_m = 5.475442123e-10;
  drag(particles, base_at(first_m + 0.5 * period_m), 100e-9, GetParam());
  const std::uint64_t yields = particles.last().yields;
  const double lost = particles.last().lost.si;
  drag(particles, base_at(first_m + 100.5 * period_m), 100e-9, GetParam());
  EXPECT_EQ(particles.last().yields - yields, 100U);
  const double seconds = 100.0 * period_m / 100e-9;
  expect_relative((particles.last().lost.si - lost) / seconds, 2.25e-16, 1e-6);
  expect_relative((particles.last().lost.si - lost) / (100.0 * period_m), 2.25e-09, 1e-6);
}

TEST_P(AtRate, AgesWhileItRests) {
  ParticleSpecies species = constant(Force(3e-9), 0.5, Length(50e-9));
  species.ageing = Time(0.1);
  const PushSetup setup = setup_of(species);
  PushedParticles particles(setup, {{0, {Length(touch_m(setup)), Length(0.0)}}}, base_at(0.0));
  drag(particles, base_at(3e-9), 100e-9, GetParam());
  expect_relative(lateral(particles.last()), 1.5e-9, 1e-9);  // force of continued sliding
  EXPECT_EQ(particles.last().yields, 1U);
  const int rests = static_cast<int>(std::lround(0.1 * GetParam()));
  for (int i = 0; i < rests; ++i) particles.move_to(base_at(3e-9), Time(1.0 / GetParam()));
  EXPECT_EQ(particles.last().state, PushState::Holds);
  // the threshold of the next tick: 1.5 nN (2 - exp(-t/0.1 s))
  expect_relative(particles.last().threshold.si, 1.5e-9 * (2.0 - std::exp(-1.0)), 1e-9);
}

// Path of a sphere beside the middle, from row N31 on.
struct Offset {
  double given;  // offset of the centre from the tip's path, relative to rho
  double after;  // travel relative to rho
};

double alpha_after(const Offset& offset, double rate_hz, double speed_m_per_s) {
  // stiff springs, so that rho is that of the undeformed bodies
  const PushSetup setup =
      setup_of(constant(Force(1e-12)), flank_tip(Length(10e-9)), {Stiffness(1e3), Stiffness(1e3), Stiffness(1e3)});
  const double rho = touch_m(setup), aside = offset.given * rho;
  const double ahead = std::sqrt(rho * rho - aside * aside);
  PushedParticles particles(setup, {{0, {Length(ahead), Length(aside)}}}, base_at(0.0));
  drag(particles, base_at(offset.after * rho), speed_m_per_s, rate_hz);
  const double x = particles.position(0).x.si - offset.after * rho;
  return degrees(std::atan2(particles.position(0).y.si, x));
}

TEST_P(AtRate, N78FollowsTheExactPathAtAnySpeed) {
  for (const double speed : {1e-7, 1e-6, 5e-6}) {
    EXPECT_NEAR(alpha_after({0.05, 3.0}, GetParam(), speed), 53.35472432, degrees(1e-4)) << speed;
  }
}

TEST_P(AtRate, N32LosesASphereBesideThePath) {
  const double offsets[] = {0.2, 0.05, 0.01};
  const double travels[] = {2.29243167, 3.688253867, 5.298292366};
  for (int i = 0; i < 3; ++i) {
    EXPECT_LT(alpha_after({offsets[i], travels[i] * 0.999}, GetParam(), 1e-6), 90.0);
    EXPECT_GT(alpha_after({offsets[i], travels[i] * 1.001}, GetParam(), 1e-6), 90.0);
  }
}

// Angle of the sphere from the tip's direction, in degrees, after a travel round a bend to its side; radius and travel
// over rho.
double alpha_round_a_bend(double radius, double alpha_deg, double travel, double rate_hz) {
  const PushSetup setup =
      setup_of(constant(Force(1e-12)), flank_tip(Length(10e-9)), {Stiffness(1e3), Stiffness(1e3), Stiffness(1e3)});
  const double rho = touch_m(setup), bend = radius * rho, alpha = alpha_deg * pi / 180.0, speed_m_per_s = 2e-7;
  PushedParticles particles(setup, {{0, {Length(bend - rho * std::sin(alpha)), Length(rho * std::cos(alpha))}}},
                            base_at(bend));
  const int ticks = static_cast<int>(std::ceil(travel * rho / speed_m_per_s * rate_hz));
  for (int i = 1; i <= ticks; ++i) {
    const double turn = travel / radius * i / ticks;
    particles.move_to(base_at(bend * std::cos(turn), bend * std::sin(turn)), Time(1.0 / rate_hz));
  }
  const double turn = travel / radius;
  const double x = particles.position(0).x.si - bend * std::cos(turn);
  const double y = particles.position(0).y.si - bend * std::sin(turn);
  const double ahead = y * std::cos(turn) - x * std::sin(turn), aside = -x * std::cos(turn) - y * std::sin(turn);
  return degrees(std::atan2(aside, ahead));
}

TEST_P(AtRate, N36BalancesRoundABend) {
  const double radius[] = {2.0, 5.0}, alpha_deg[] = {30.0, 11.53695903}, growth[] = {0.8660254038, 0.9797958971};
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(alpha_round_a_bend(radius[i], alpha_deg[i], 3.0, GetParam()), alpha_deg[i], degrees(1e-4));
    // a deviation grows by e within rho over that rate
    const double more = alpha_round_a_bend(radius[i], alpha_deg[i] + 0.1, 1.0, GetParam());
    const double less = alpha_round_a_bend(radius[i], alpha_deg[i] - 0.1, 1.0, GetParam());
    EXPECT_NEAR(std::log((more - less) / 0.2), growth[i], 1e-4);
  }
}

TEST_P(AtRate, N75AClosedPathTakesWork) {
  for (const double ratio : {1.0, 0.5}) {
    ParticleSpecies species = constant(Force(3e-9), ratio, Length(50e-9));
    species.ageing = Time(1e6);  // one slip, then f_k
    const PushSetup setup = setup_of(species);
    PushedParticles particles(setup, {{0, {Length(touch_m(setup)), Length(0.0)}}}, base_at(0.0));
    const double start = particles.position(0).x.si;
    drag(particles, base_at(20e-9), 1e-7, GetParam());
    drag(particles, base_at(0.0), 1e-7, GetParam());
    expect_relative(particles.last().given.si, ratio == 1.0 ? 5.835736736e-17 : 2.979467092e-17, 1e-5);
    expect_relative(particles.position(0).x.si - start, ratio == 1.0 ? 1.945245579e-08 : 1.972622789e-08, 1e-5);
    EXPECT_EQ(particles.last().work, particles.last().given);  // exact for a lone sphere
    EXPECT_NEAR(particles.last().stored.si, 0.0, 1e-30);
  }
}

// Pushes by so little, with such stiff springs, that the angles stay those of the row: by 1e-7 of rho, after a
// thousandth of that to load the springs.
struct Group {
  std::vector<double> angles_deg;  // directions from the push to the spheres that A touches
  bool pinned = false;
};

constexpr double kPush = 4e-15;       // length in m
constexpr double kThreshold = 1e-10;  // threshold of each sphere in N
constexpr Stiffness kStiff{1e6};
constexpr double kAlmost = 1e-6;  // relative tolerance of the table

struct Pushed {
  double force = 0.0;                   // force on the tip, relative to the threshold
  std::vector<Sideways<Length>> moved;  // path in the second half of the push
  PushState state = PushState::Free;
};

Pushed push(const std::vector<PlacedParticle>& placed, double rate_hz) {
  PushSetup setup{flank_tip(Length(10e-9), 0.0), {kStiff, kStiff, kStiff}, 0.0, {constant(Force(kThreshold))}};
  PushedParticles particles(setup, placed, base_at(0.0));
  Pushed pushed;
  drag(particles, base_at(0.5 * kPush), 50.0 * kPush, rate_hz);
  for (std::size_t i = 0; i < placed.size(); ++i) pushed.moved.push_back(particles.position(i));
  drag(particles, base_at(kPush), 50.0 * kPush, rate_hz);
  for (std::size_t i = 0; i < placed.size(); ++i) pushed.moved[i] = particles.position(i) - pushed.moved[i];
  pushed.force = lateral(particles.last()) / kThreshold;
  pushed.state = particles.last().state;
  return pushed;
}

Pushed push(const Group& group, double rate_hz) {
  std::vector<PlacedParticle> placed{{0, {Length(35e-9), Length(0.0)}}};
  for (const double angle_deg : group.angles_deg) {
    const double angle = angle_deg * pi / 180.0;
    placed.push_back({0, {Length(35e-9 + 50e-9 * std::cos(angle)), Length(50e-9 * std::sin(angle))}, group.pinned});
  }
  return push(placed, rate_hz);
}

TEST_P(AtRate, N40TwoSpheresMoveWithTheLeastDissipation) {
  const Pushed pushed = push(Group{{30.0}}, GetParam());
  const Sideways<Length> a = pushed.moved[0], b = pushed.moved[1];
  expect_relative(a.y / a.x, -0.5773502692, kAlmost);
  expect_relative(magnitude(b) / a.x, 0.5773502692, kAlmost);
  expect_relative(pushed.force, 1.732050808, kAlmost);
}

TEST_P(AtRate, N42ASphereSlidesRoundAnother) {
  const Pushed pushed = push(Group{{60.0}}, GetParam());
  expect_relative(pushed.moved[0].y / pushed.moved[0].x, -0.5773502692, kAlmost);
  EXPECT_EQ(pushed.moved[1], (Sideways<Length>{}));
  expect_relative(pushed.force, 1.154700538, kAlmost);
}

TEST_P(AtRate, N43ASphereAgainstAWall) {
  const double forces[] = {2.0, 1.154700538}, slopes[] = {-1.732050808, -0.5773502692};
  for (int i = 0; i < 2; ++i) {
    const Pushed pushed = push(Group{{30.0 * (i + 1)}, true}, GetParam());
    expect_relative(pushed.force, forces[i], kAlmost);
    expect_relative(pushed.moved[0].y / pushed.moved[0].x, slopes[i], kAlmost);
  }
}

TEST_P(AtRate, N44AWedgeAndAChain) {
  expect_relative(push(Group{{30.0, -30.0}}, GetParam()).force, 2.732050808, kAlmost);
  std::vector<PlacedParticle> chain;
  for (int i = 0; i < 5; ++i) chain.push_back({0, {Length(35e-9 + 50e-9 * i), Length(0.0)}});
  const Pushed pushed = push(chain, GetParam());
  expect_relative(pushed.force, 5.0, kAlmost);
  EXPECT_EQ(pushed.state, PushState::Several);
}

TEST(PushedParticles, LeaveAGentleTipAboveThemAlone) {
  const PushSetup setup = setup_of(gold());
  PushedParticles particles(setup, {{0, {Length(60e-9), Length(0.0)}}}, base_at(0.0, 0.0, 60e-9));
  drag(particles, base_at(120e-9, 0.0, 60e-9), 1e-6, 1000.0);
  EXPECT_EQ(particles.position(0).x.si, 60e-9);
  EXPECT_EQ(particles.last().state, PushState::Free);
  EXPECT_EQ(particles.last().given, Energy(0.0));
}

// Rows N26 and N82 by the tick: a lever below its softest rides over, one above pushes.
TEST(PushedParticles, AreRiddenOverByASoftLever) {
  for (const double share : {0.97, 1.03}) {
    ParticleSpecies species = gold();
    species.kinetic_ratio = 1.0;
    PushSetup setup = setup_of(species);
    setup.springs.normal = Stiffness(0.002820784137 * share);
    setup.springs.contact = Stiffness(1e4);
    PushedParticles particles(setup, {{0, {Length(touch_m(setup)), Length(0.0)}}}, base_at(0.0));
    drag(particles, base_at(60e-9), 1e-7, 1000.0);
    if (share < 1.0) {
      EXPECT_LT(particles.position(0).x.si, touch_m(setup) + 1e-9);
      EXPECT_GT(particles.last().base.position.x.si, 59e-9);
    } else {
      EXPECT_GT(particles.position(0).x.si, touch_m(setup) + 10e-9);
    }
  }
}

TEST(PushedParticles, LagBehindAHandThatIsTooFastAndComeAfter) {
  const PushSetup setup = setup_of(constant(Force(1e-9)));
  PushedParticles particles(setup, {{0, {Length(100e-9), Length(0.0)}}}, base_at(0.0));
  particles.move_to(base_at(80e-9), Time(1e-3));
  EXPECT_TRUE(particles.last().lagging);
  EXPECT_LT(particles.last().base.position.x.si, 20e-9);
  for (int i = 0; i < 20; ++i) particles.move_to(base_at(80e-9), Time(1e-3));
  EXPECT_FALSE(particles.last().lagging);
  EXPECT_EQ(particles.last().base.position.x.si, 80e-9);
  EXPECT_GT(particles.position(0).x.si, 119e-9);
}

TEST(PushedParticles, DoNotAllocateInATickNorListenToNoNumber) {
  std::vector<PlacedParticle> placed;
  for (int i = 0; i < 30; ++i) placed.push_back({0, {Length(51e-9 * (i % 6)), Length(51e-9 * (i / 6))}});
  PushedParticles particles(setup_of(gold()), placed, base_at(-60e-9));
  {
    const afm::test::NoAllocation none;
    for (int i = 0; i < 400; ++i) particles.move_to(base_at(-60e-9 + 1e-9 * i, 60e-9 + 0.2e-9 * i), Time(1e-3));
    particles.move_to(base_at(std::numeric_limits<double>::quiet_NaN()), Time(1e-3));
  }
  EXPECT_TRUE(std::isfinite(particles.last().stored.si));
  EXPECT_TRUE(std::isfinite(lateral(particles.last())));
  EXPECT_GT(particles.last().lost.si, 0.0);
}

std::string refusal(const PushSetup& setup, const std::vector<PlacedParticle>& placed) {
  try {
    const PushedParticles particles(setup, placed, base_at(0.0));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PushedParticles, RefuseWhatCannotLieOnASample) {
  const PushSetup setup = setup_of(gold());
  EXPECT_EQ(refusal(setup, {{0, {Length(0.0), Length(0.0)}}, {0, {Length(49e-9), Length(0.0)}}}),
            "particles 1 and 2 overlap: their centres are 49 nm apart and touch at 50 nm");
  EXPECT_EQ(refusal(setup, {{1, {}}}), "particle 1 is of an unknown species");
  PushSetup blunt = setup;
  blunt.tip.radius = Length(60e-9);
  EXPECT_EQ(refusal(blunt, {}), "radius 25 nm is not within 30 nm to 10 um");
  PushSetup idle = setup;
  idle.species.front().shear_strength = Pressure(0.0);
  EXPECT_NE(refusal(idle, {}).find("shear strength"), std::string::npos);
  EXPECT_EQ(refusal(setup, {}), "");
}

}  // namespace pushed_particles_test
}  // namespace afm::physics
