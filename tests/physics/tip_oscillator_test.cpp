// SPDX-License-Identifier: Apache-2.0
// Invariant: an oscillating tip obeys equipartition, loses energy without noise, and stays bounded at any depth
#include "physics/tip_oscillator.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "mica.h"
#include "physics/thermal_noise.h"

namespace afm::physics {
namespace tip_oscillator_test {

using namespace literals;

constexpr Stiffness kSpring(0.1);
const Length kFarAway = 10_um;

std::shared_ptr<const TipForce> surface(Law law, Force largest_load = 20_nN) {
  return std::make_shared<const TipForce>(*fixed_grips(law, elastic_mica()), largest_load);
}

TipOscillator oscillator(Law law, const LeverDynamics& lever, double share_of_longest = 1.0, std::uint64_t seed = 1) {
  const auto force = surface(law);
  return {force, kSpring, lever, share_of_longest * TipOscillator::longest_sub_step(*force, kSpring, lever), seed};
}

TEST(TipForce, IsTheForceOfItsTables) {
  for (const Law law : {Law::Dmt, Law::Jkr, Law::MaugisDugdale, Law::LennardJones}) {
    const auto grips = fixed_grips(law, elastic_mica());
    const TipForce force(*grips, 20_nN);
    // a tenth of the thermal force: the kinks of Maugis-Dugdale do not lie at the ends
    const double rounded = law == Law::MaugisDugdale ? 2e-12 : 0.0;
    bool attached = false;
    for (double h = 100e-9; h > force.contact_height().si + 1e-14; h *= 0.999) {
      const double expected = grips->free.force(Length(h)).si;
      EXPECT_NEAR(force(Length(h), attached).si, expected, 5e-5 * std::abs(expected) + rounded)
          << name_of(law) << " at " << h;
      EXPECT_FALSE(attached);
    }
    for (double depth = 1e-13; depth < 1e-9; depth *= 1.01) {
      const Length h = force.contact_height() - Length(depth);
      const double expected = grips->attached.force(h).si;
      if (expected > 20e-9) break;
      EXPECT_NEAR(force(h, attached).si, expected, 3e-4 * std::abs(expected) + rounded + 1e-13)
          << name_of(law) << " at " << depth;
      EXPECT_TRUE(attached);
    }
  }
}

TEST(TipForce, RemembersTheContactOfALawThatIsHystereticByItself) {
  const auto force = surface(Law::Jkr);
  ASSERT_GT(force->release_height(), force->contact_height());
  const Length between = 0.5 * (force->release_height() + force->contact_height());
  bool attached = false;
  EXPECT_EQ((*force)(between, attached), 0_nN);
  EXPECT_FALSE(attached);
  (*force)(force->contact_height() - 1_pm, attached);
  EXPECT_LT((*force)(between, attached), 0_nN);
  EXPECT_TRUE(attached);
  EXPECT_EQ((*force)(force->release_height() + 1_pm, attached), 0_nN);
  EXPECT_FALSE(attached);
}

TEST(TipForce, GoesOnStraightWhereItWouldOutrunTheIntegrator) {
  const auto force = surface(Law::LennardJones, 1_nN);
  bool attached = true;
  const auto slope = [&](Length h) { return ((*force)(h - 1_pm, attached) - (*force)(h, attached)) / 1_pm; };
  for (double depth = 1e-10; depth < 1e-4; depth *= 1.5) {
    EXPECT_LE(slope(force->contact_height() - Length(depth)).si,
              TipForce::kSteepestRatio * force->stiffness().si * 1.0001);
  }
}

TEST(TipForce, IsFiniteForEveryFiniteHeight) {
  const auto force = surface(Law::Dmt);
  for (const double height : {1e300, -1e300, 0.0, 1e-320}) {
    bool attached = false;
    EXPECT_TRUE(isfinite((*force)(Length(height), attached))) << height;
  }
}

// A and O keep the canonical distribution whatever the length of a sub-step.
TEST(TipOscillator, SharesTheHeatEquallyForEverySubStep) {
  const auto force = surface(Law::Hertz);
  for (const double quality : {0.5, 3.0}) {
    const LeverDynamics lever{12_kHz, quality, 298_K};
    const double period = 1.0 / 12e3;
    for (const double steps_a_period : {4.0, 20.0, 300.0}) {
      TipOscillator free(force, kSpring, lever, Time(period / steps_a_period), 5);
      free.settle(kFarAway, Velocity());
      const double mass = 0.1 / std::pow(2.0 * std::numbers::pi * 12e3, 2);
      double potential = 0.0, kinetic = 0.0;
      constexpr int kCount = 2'000'000;
      for (int i = 0; i < kCount; ++i) {
        free.sub_step();
        potential += 0.1 * free.deflection().si * free.deflection().si;
        kinetic += mass * free.velocity().si * free.velocity().si;
      }
      // samples of one correlation time are worth one: five standard errors
      const double independent = kCount / (1.0 + quality * steps_a_period / std::numbers::pi);
      const double energy = thermal_energy(298_K).si;
      EXPECT_NEAR(potential / kCount / energy, 1.0, 5.0 * std::sqrt(2.0 / independent))
          << quality << " " << steps_a_period;
      EXPECT_NEAR(kinetic / kCount / energy, 1.0, 5.0 * std::sqrt(2.0 / independent))
          << quality << " " << steps_a_period;
    }
  }
}

TEST(TipOscillator, LosesEnergyInEverySubStepWithoutHeatAndSurface) {
  const LeverDynamics lever{12_kHz, 20.0, 0_K};
  TipOscillator ringing = oscillator(Law::Hertz, lever);
  ringing.place(kFarAway, kFarAway + 10_nm, Velocity());
  const double w0 = 2.0 * std::numbers::pi * 12e3;
  const auto energy = [&] { return std::pow(ringing.deflection().si, 2) + std::pow(ringing.velocity().si / w0, 2); };
  const double first = energy();
  double before = first, time = 0.0;
  const Time step = TipOscillator::longest_sub_step(ringing.surface(), kSpring, lever);
  while (time < 20.0 / w0) {
    ringing.sub_step();
    time += step.si;
    EXPECT_LE(energy(), before * (1.0 + 1e-15));
    before = energy();
  }
  // exp(-w0 t/Q), up to the swing of the loss between the two kinds of energy, 1/Q
  EXPECT_NEAR(before / first / std::exp(-w0 * time / 20.0), 1.0, 1.0 / 20.0);
}

// Without damping the integrator is reversible: a tip that bounces on an elastic sample keeps its height.
TEST(TipOscillator, BouncesAsHighAsItFell) {
  const LeverDynamics lever{12_kHz, 1e7, 0_K};
  TipOscillator bouncing = oscillator(Law::Dmt, lever);
  bouncing.place(2_nm, 6_nm, Velocity());
  std::vector<double> tops;
  double before = bouncing.velocity().si;
  while (tops.size() < 100) {
    bouncing.sub_step();
    if (before > 0.0 && bouncing.velocity().si <= 0.0 && bouncing.height() > 2_nm) tops.push_back(bouncing.height().si);
    before = bouncing.velocity().si;
  }
  for (const double top : tops) EXPECT_NEAR(top, 6e-9, 0.01e-9);
}

TEST(TipOscillator, IsSecondOrderInTheSubStep) {
  // the height after 0.2 ms of a lever that snaps in and swings in contact
  const LeverDynamics lever{12_kHz, 2.5, 0_K};
  const auto force = surface(Law::Dmt);
  const auto height_after = [&](int sub_steps) {
    TipOscillator tip(force, kSpring, lever, Time(20e-6 / sub_steps), 1);
    tip.place(1.5_nm, 0.6_nm, Velocity());
    for (int i = 0; i < sub_steps; ++i) tip.sub_step();
    return tip.height().si;
  };
  const double exact = height_after(64 * 400);
  const double coarse = height_after(400) - exact, fine = height_after(800) - exact;
  EXPECT_GT(std::abs(coarse), 1e-15);
  EXPECT_NEAR(coarse / fine, 4.0, 0.8);
}

TEST(TipOscillator, RestsWhereItSettles) {
  const LeverDynamics lever{12_kHz, 2.5, 0_K};
  TipOscillator resting = oscillator(Law::Dmt, lever);
  resting.settle(2.6_nm, Velocity());
  const Length height = resting.height();
  EXPECT_LT(height, 2.6_nm);
  for (int i = 0; i < 10000; ++i) resting.sub_step();
  EXPECT_NEAR(resting.height().si, height.si, 1e-17);
  bool attached = resting.attached();
  const Force force = resting.surface()(resting.height(), attached);
  EXPECT_NEAR((force - kSpring * resting.deflection()).si, 0.0, 1e-18);
}

TEST(TipOscillator, FollowsItsSeedAndNothingElse) {
  const LeverDynamics lever{12_kHz, 2.5, 298_K};
  TipOscillator first = oscillator(Law::Dmt, lever, 1.0, 9), again = first,
                other = oscillator(Law::Dmt, lever, 1.0, 10);
  for (TipOscillator* tip : {&first, &again, &other}) tip->settle(3_nm, Velocity());
  int alike = 0;
  for (int i = 0; i < 1000; ++i) {
    for (TipOscillator* tip : {&first, &again, &other}) tip->sub_step();
    EXPECT_EQ(first.height(), again.height());
    alike += first.height() == other.height() ? 1 : 0;
  }
  EXPECT_EQ(alike, 0);
}

TEST(TipOscillator, StaysBoundedHoweverDeepItIsPushed) {
  for (const Law law : {Law::Dmt, Law::LennardJones}) {
    TipOscillator pushed = oscillator(law, {12_kHz, 2.5, 298_K});
    pushed.settle(50_nm, Velocity());
    // ten thousand times as deep as the deepest impact
    pushed.place(-10_um, -1_nm, Velocity());
    for (int i = 0; i < 100000; ++i) {
      pushed.sub_step();
      ASSERT_LT(std::abs(pushed.height().si), 1e-6) << name_of(law);
    }
  }
}

}  // namespace tip_oscillator_test
}  // namespace afm::physics
