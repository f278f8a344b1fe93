// SPDX-License-Identifier: Apache-2.0
#include "fits/driven_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace afm::fits {
namespace driven_contact_test {

constexpr double kModulusPa = 4000.0, kRadiusM = 5e-6, kSpring = 0.05;

DrivenContact hertz() { return {{.shape = Shape::Paraboloid, .radius_m = kRadiusM}, kModulusPa, 0.0, kSpring}; }

TEST(DrivenContact, OfHertzBendsTheLeverByTheClosedFormula) {
  DrivenContact contact = hertz();
  for (const double depth_m : {1e-12, 1e-9, 3e-7, 2e-6}) {
    const double force_n = 4.0 / 3.0 * kModulusPa * std::sqrt(kRadiusM) * std::pow(depth_m, 1.5);
    const double way_m = depth_m + force_n / kSpring;
    for (const auto& state : {contact.approaching(way_m), contact.retracting(way_m)}) {
      EXPECT_NEAR(state.depth_m, depth_m, 1e-10 * depth_m);
      EXPECT_NEAR(state.force_n, force_n, 1e-10 * force_n);
    }
    EXPECT_NEAR(contact.way_of(force_n), way_m, 1e-10 * way_m);
  }
  EXPECT_EQ(contact.approaching(-1e-9).force_n, 0.0);
  EXPECT_EQ(contact.way_off_m(), 0.0);
}

// Johnson, Kendall & Roberts in the contact radius.
TEST(DrivenContact, OfJkrHasTwoForcesAtOneHeight) {
  constexpr double kPa = 1e6, kWork = 20e-3, kRadius = 1e-6, kLever = 1.0;
  DrivenContact contact({.shape = Shape::Jkr, .radius_m = kRadius}, kPa, kWork, kLever);
  for (const double a : {0.35e-6, 0.4e-6, 0.5e-6}) {
    const double pull_n = std::sqrt(8.0 * std::numbers::pi * kWork * kPa * a * a * a);
    const double force_n = 4.0 / 3.0 * kPa * a * a * a / kRadius - pull_n;
    const double depth_m = a * a / kRadius - std::sqrt(2.0 * std::numbers::pi * kWork * a / kPa);
    const double way_m = depth_m + force_n / kLever;
    EXPECT_NEAR(contact.retracting(way_m).force_n, force_n, 1e-9 * std::abs(pull_n)) << a;
    if (way_m < 0.0) {
      EXPECT_EQ(contact.approaching(way_m).force_n, 0.0) << a;
    }
  }
  EXPECT_LT(contact.way_off_m(), 0.0);
  EXPECT_EQ(contact.retracting(1.0001 * contact.way_off_m()).force_n, 0.0);
  EXPECT_LT(contact.retracting(0.9999 * contact.way_off_m()).force_n, 0.0);
  EXPECT_NEAR(contact.pull_off_n(), 1.5 * std::numbers::pi * kWork * kRadius, 1e-15);
}

TEST(DrivenContact, PushesByTheForceThatWasAskedFor) {
  DrivenContact contact({.shape = Shape::Maugis, .radius_m = 1e-7}, 1e8, 50e-3, 2.0);
  for (const double force_n : {1e-12, 1e-9, 1e-6}) {
    EXPECT_NEAR(contact.approaching(contact.way_of(force_n)).force_n, force_n, 1e-6 * force_n + 1e-18);
  }
}

}  // namespace driven_contact_test
}  // namespace afm::fits
