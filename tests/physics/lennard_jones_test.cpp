// SPDX-License-Identifier: Apache-2.0
#include "physics/lennard_jones.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "physics/van_der_waals.h"
#include "random_interaction.h"

namespace afm::physics {
namespace lennard_jones_test {

using namespace literals;
using std::numbers::pi;

constexpr double kRounding = 1e-13;
// central differences over 1e-5 of the gap
constexpr double kDifferenceError = 1e-7;
constexpr int kMaterials = 10'000;

LennardJones law_of(const ContactParameters& m) {
  return {2.0 * m.mean_surface_energy, m.tip_radius, m.atomic_distance};
}

// F = (A R/(6 sigma^2)) [(sigma/D)^8/30 - (sigma/D)^2] (Sarid 1994; Fok, Liu & Li 2004): z0 = 7.5^(-1/6) sigma and
// W = A/(16 pi z0^2).
LennardJones of_hamaker(Energy hamaker, Length tip_radius, Length sigma) {
  const Length z0 = sigma * std::pow(7.5, -1.0 / 6.0);
  return {hamaker / (16.0 * pi * z0 * z0), tip_radius, z0};
}

TEST(LennardJones, ForceIsTheSlopeOfThePotentialAndGradientThatOfTheForce) {
  RandomInteraction random(1);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    const LennardJones law = law_of(m);
    const Length z0 = law.atomic_distance();
    const Length gap = random.between(0.5, 1e3) * z0;
    const Length step = 1e-5 * gap;
    // relative to the size of the terms, which cancel near the minima
    const double x = z0 / gap;
    const double scale = (m.tip_radius * m.mean_surface_energy).si * (x * x + std::pow(x, 8.0));
    const Force slope = -(law.potential(gap + step) - law.potential(gap - step)) / (2.0 * step);
    EXPECT_NEAR(slope.si, law.force(gap).si, kDifferenceError * scale);
    const Stiffness steepness = (law.force(gap + step) - law.force(gap - step)) / (2.0 * step);
    EXPECT_NEAR((steepness * gap).si, (law.gradient(gap) * gap).si, 30.0 * kDifferenceError * scale);
  }
}

// max dF/dD, at 3^(1/6) z0: a lever that is at least as stiff follows the law without a jump.
Stiffness steepest_attraction(const LennardJones& law) {
  return law.gradient(std::pow(3.0, 1.0 / 6.0) * law.atomic_distance());
}

TEST(LennardJones, PullsHardestAtTheAtomicDistanceWithTwoPiRW) {
  RandomInteraction random(2);
  for (int i = 0; i < kMaterials; ++i) {
    const ContactParameters m = random();
    const LennardJones law = law_of(m);
    EXPECT_NEAR(law.force(m.atomic_distance).si, -4.0 * pi * (m.tip_radius * m.mean_surface_energy).si,
                kRounding * -law.force(m.atomic_distance).si);
    EXPECT_NEAR((law.gradient(m.atomic_distance) / steepest_attraction(law)), 0.0, kRounding);
  }
}

TEST(LennardJones, NothingIsSteeperThanTheSteepestAttraction) {
  const LennardJones law(50_mJ_per_m2, 50_nm, 0.3_nm);
  for (Length gap = 0.1_nm; gap < 100_nm; gap = gap * 1.0001) EXPECT_LE(law.gradient(gap), steepest_attraction(law));
}

// Sarid's form, written out as Fok, Liu & Li print it.
TEST(LennardJones, BothPublishedFormsAreOneLaw) {
  RandomInteraction random(3);
  for (int i = 0; i < kMaterials; ++i) {
    const double a = random.between(1e-21, 5e-19);
    const double r = random.between(1e-9, 1e-5);
    const double sigma = random.between(0.2e-9, 1e-9);
    const double gap = sigma * random.between(0.5, 100.0);
    const double x = sigma / gap;
    const double sarid = a * r / (6.0 * sigma * sigma) * (std::pow(x, 8.0) / 30.0 - x * x);
    const double size = a * r / (6.0 * sigma * sigma) * (std::pow(x, 8.0) / 30.0 + x * x);
    const auto law = of_hamaker(Energy(a), Length(r), Length(sigma));
    EXPECT_NEAR(law.force(Length(gap)).si, sarid, kRounding * size);
  }
  const auto law = of_hamaker(24.5_zJ, 50_nm, 0.4_nm);
  EXPECT_NEAR(law.atomic_distance() / 0.4_nm, 0.714754, 1e-6);
  const Force unit = 24.5_zJ * 50_nm / (6.0 * 0.4_nm * 0.4_nm);
  EXPECT_NEAR(law.force(law.atomic_distance()) / unit, -1.4681, 5e-5);
  EXPECT_NEAR(law.force(0.4_nm * std::pow(30.0, -1.0 / 6.0)) / unit, 0.0, kRounding);
}

TEST(LennardJones, IsVanDerWaalsFarAway) {
  const auto law = of_hamaker(24.5_zJ, 50_nm, 0.4_nm);
  const VanDerWaals tail(24.5_zJ, 50_nm);
  for (const Length gap : {20_nm, 1_um}) {
    EXPECT_NEAR(law.force(gap) / tail.force(gap), 1.0, 1e-9);
    EXPECT_NEAR(law.potential(gap) / tail.potential(gap), 1.0, 1e-9);
  }
}

}  // namespace lennard_jones_test
}  // namespace afm::physics
