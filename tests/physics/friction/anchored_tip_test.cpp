// SPDX-License-Identifier: Apache-2.0
// Invariant: friction costs energy on every closed path
#include "physics/friction/anchored_tip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace afm::physics {
namespace anchored_tip_test {

using namespace literals;

constexpr Stiffness kSpring = 2_N_per_m;
constexpr Force kYield = 1_nN;

Sideways<Length> place(double x_m, double y_m = 0.0) { return {Length(x_m), Length(y_m)}; }

TEST(AnchoredTip, HoldsUntilItYieldsAndDragsItsAnchorBeyond) {
  AnchoredTip tip(kSpring);
  tip.land(place(1e-9));
  EXPECT_EQ(tip.move_to(place(1.2e-9), kYield), Energy());
  EXPECT_NEAR(tip.force().x.si, -0.4e-9, 1e-20);
  const Energy lost = tip.move_to(place(2e-9), kYield);
  EXPECT_NEAR(tip.force().x.si, -1e-9, 1e-20);
  EXPECT_NEAR(lost.si, 1e-9 * 0.5e-9, 1e-30);
  EXPECT_EQ(tip.move_to(place(1.5e-9), kYield), Energy());
  EXPECT_NEAR(tip.force().x.si, 0.0, 1e-20);
  tip.move_to(place(-3e-9), kYield);
  EXPECT_NEAR(tip.force().x.si, 1e-9, 1e-20);
}

TEST(AnchoredTip, DoesNotDriftUnderATremor) {
  AnchoredTip tip(kSpring);
  tip.land(place(0.0));
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> tremor(-0.2e-9, 0.2e-9);
  for (int i = 0; i < 100'000; ++i) {
    const double x_m = tremor(random);
    tip.move_to(place(x_m, tremor(random)), kYield);
  }
  tip.move_to(place(0.0), kYield);
  EXPECT_NEAR(magnitude(tip.force()).si, 0.0, 1e-20);
}

TEST(AnchoredTip, GivesTheSameOnAStraightPathWhateverTheSteps) {
  const Sideways<Length> begin = place(0.3e-9, 0.45e-9), end = place(4e-9, -1.5e-9);
  Sideways<Force> reference;
  double lost_in_one = 0.0;
  for (const int steps : {1, 2, 7, 100, 10'000}) {
    AnchoredTip tip(kSpring);
    tip.land(place(0.0));
    tip.move_to(begin, kYield);
    double lost = 0.0;
    for (int i = 1; i <= steps; ++i) {
      lost += tip.move_to(begin + (end - begin) * (static_cast<double>(i) / steps), kYield).si;
    }
    if (steps == 1) {
      reference = tip.force();
      lost_in_one = lost;
    }
    EXPECT_LT(magnitude(tip.force() - reference).si, 1e-12 * kYield.si) << steps;
    EXPECT_NEAR(lost, lost_in_one, 1e-12 * lost_in_one) << steps;
  }
}

TEST(AnchoredTip, FollowsATractrixAroundACorner) {
  AnchoredTip tip(kSpring);
  tip.land(place(0.0));
  tip.move_to(place(3e-9), kYield);
  tip.move_to(place(3e-9, 0.5e-9), kYield);
  // for a leash of 0.5 nm at right angles to the path: tan(angle/2) = exp(-1)
  const double half = std::exp(-1.0);
  EXPECT_NEAR(tip.force().x.si / kYield.si, -2.0 * half / (1.0 + half * half), 1e-12);
}

// 10^5 closed paths with loads that change, against the sum of the force over fine steps.
TEST(AnchoredTip, NeverGivesEnergyOnAClosedPath) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> way(-1e-9, 1e-9), share(0.0, 1.0);
  int slid = 0;
  for (int path = 0; path < 100'000; ++path) {
    AnchoredTip tip(kSpring);
    const auto anywhere = [&] {
      const double x_m = way(random);
      return place(x_m, way(random));
    };
    const Sideways<Length> start = anywhere();
    tip.land(start);
    double paid = 0.0, all = 0.0, lost = 0.0;
    Sideways<Length> at = start;
    const int ways = 2 + path % 4;
    for (int i = 0; i < ways; ++i) {
      const Sideways<Length> to = i == ways - 1 ? start : anywhere();
      const double before = tip.stored().si;
      const double gone = tip.move_to(to, kYield * share(random)).si;
      ASSERT_GE(gone, 0.0);
      lost += gone;
      paid += tip.stored().si - before + gone;
      all += std::abs(tip.stored().si - before) + gone;
      at = to;
    }
    slid += lost > 0.0 ? 1 : 0;
    // no energy was stored at the beginning
    ASSERT_GE(paid, -1e-12 * all);
    ASSERT_LE(tip.stored().si, paid + 1e-12 * all);
  }
  EXPECT_GT(slid, 90'000);
}

TEST(AnchoredTip, LosesTheWorkOfItsForce) {
  AnchoredTip tip(kSpring);
  tip.land(place(0.0));
  double work = 0.0, lost = 0.0;
  Sideways<Length> at = place(0.0);
  constexpr int kSteps = 200'000;
  for (int i = 1; i <= kSteps; ++i) {
    const double angle = 2.0 * M_PI * i / kSteps;
    const Sideways<Length> to = place(2e-9 * std::sin(angle), 1e-9 * std::sin(2.0 * angle));
    const Sideways<Force> before = tip.force();
    lost += tip.move_to(to, kYield).si;
    work -= 0.5 * dot(before + tip.force(), to - at).si;
    at = to;
  }
  EXPECT_NEAR(work, lost + tip.stored().si, 1e-7 * work);
}

}  // namespace anchored_tip_test
}  // namespace afm::physics
