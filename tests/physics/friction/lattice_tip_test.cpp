// SPDX-License-Identifier: Apache-2.0
// Invariant: friction and its slips depend neither on the tick nor on the speed
#include "physics/friction/lattice_tip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "physics/friction/prandtl_tomlinson.h"
#include "support/deep.h"

namespace afm::physics {
namespace lattice_tip_test {

using namespace literals;

constexpr Length kPeriod = 0.52_nm;
constexpr Stiffness kSpring = 1_N_per_m;

Energy row_amplitude(double eta) {
  return Energy(eta * kSpring.si * kPeriod.si * kPeriod.si / (2.0 * std::numbers::pi * std::numbers::pi));
}

Sideways<Length> place(double x_m, double y_m = 0.0) { return {Length(x_m), Length(y_m)}; }

class LatticeOfAnyKind : public testing::TestWithParam<LatticeKind> {
 protected:
  Energy scale(double eta) const { return scale_of_row(GetParam(), row_amplitude(eta)); }
};

INSTANTIATE_TEST_SUITE_P(Kinds, LatticeOfAnyKind,
                         testing::Values(LatticeKind::Rows, LatticeKind::Square, LatticeKind::Hexagonal));

// All slips of a straight pull, in steps of fixed length.
std::vector<LatticeSlip> pull(LatticeTip& tip, const Sideways<Length>& from, const Sideways<Length>& to, int steps,
                              Energy scale) {
  std::vector<LatticeSlip> slips;
  for (int i = 1; i <= steps; ++i) {
    const auto step = tip.move_to(from + (to - from) * (static_cast<double>(i) / steps), scale);
    for (const LatticeSlip& slip : step.slipped()) slips.push_back(slip);
  }
  return slips;
}

TEST_P(LatticeOfAnyKind, SlipsAlongARowWhereTheSineDoes) {
  for (const double eta : {1.05, 1.2, 2.0, 5.0, 20.0}) {
    const SineSlip expected = first_slip({kPeriod, row_amplitude(eta), kSpring}).value();
    LatticeTip tip(GetParam(), kPeriod, kSpring);
    tip.land(place(0.0), scale(eta));
    const auto slips = pull(tip, place(0.0), place(2.5 * kPeriod.si + expected.support.si), 100, scale(eta));
    ASSERT_EQ(slips.size(), 3U) << eta;
    for (std::size_t i = 0; i < slips.size(); ++i) {
      EXPECT_NEAR(slips[i].support.x.si, expected.support.si + static_cast<double>(i) * kPeriod.si, 1e-9 * kPeriod.si)
          << eta;
      EXPECT_NEAR(slips[i].force_before.x.si, -expected.force_before.si, 1e-7 * expected.force_before.si) << eta;
      EXPECT_NEAR(slips[i].force_after.x.si, -expected.force_after.si, 1e-6 * expected.force_before.si) << eta;
      EXPECT_NEAR(slips[i].lost.si, expected.lost.si, 1e-6 * expected.lost.si) << eta;
      EXPECT_NEAR(slips[i].way.y.si, 0.0, 1e-15);
    }
  }
}

TEST_P(LatticeOfAnyKind, NeitherSlipsNorLosesAnythingWhereTheSpringIsStiff) {
  LatticeTip tip(GetParam(), kPeriod, kSpring);
  const double eta = 0.8;
  tip.land(place(0.0), scale(eta));
  EXPECT_TRUE(pull(tip, place(0.0), place(5.0 * kPeriod.si), 137, scale(eta)).empty());
  EXPECT_NEAR(tip.force().x.si, 0.0, 1e-18);
  tip.move_to(place(5.0 * kPeriod.si + 1e-14), scale(eta));
  EXPECT_NEAR(-tip.force().x.si / 1e-14, slope_at_rest({kPeriod, row_amplitude(eta), kSpring}).si, 1e-3);
}

TEST_P(LatticeOfAnyKind, GivesTheSameForcesAndSlipsWhateverTheSteps) {
  const double eta = 4.0;
  const Sideways<Length> from = place(0.11e-9, -0.07e-9), to = place(3.9e-9, 2.3e-9);
  std::vector<LatticeSlip> reference;
  for (const int steps : {2000, 500, 123, 40, 9}) {
    LatticeTip tip(GetParam(), kPeriod, kSpring);
    tip.land(from, scale(eta));
    const auto slips = pull(tip, from, to, steps, scale(eta));
    if (reference.empty()) {
      reference = slips;
      ASSERT_GE(slips.size(), 5U);
    }
    ASSERT_EQ(slips.size(), reference.size()) << steps;
    for (std::size_t i = 0; i < slips.size(); ++i) {
      EXPECT_LT(magnitude(slips[i].support - reference[i].support).si, 1e-8 * kPeriod.si) << steps;
      EXPECT_NEAR(slips[i].lost.si, reference[i].lost.si, 1e-6 * reference[i].lost.si) << steps;
      EXPECT_LT(magnitude(slips[i].force_after - reference[i].force_after).si, 1e-16) << steps;
    }
  }
}

TEST(HexagonalLattice, MakesTheTipZigzagWhereItIsPulledAcrossTheRows) {
  LatticeTip tip(LatticeKind::Hexagonal, kPeriod, kSpring);
  const Energy scale = scale_of_row(LatticeKind::Hexagonal, row_amplitude(5.0));
  // just beside the mirror line, on which it could go either way
  const double beside = 1e-4 * kPeriod.si, across = std::numbers::sqrt3 * kPeriod.si;
  tip.land(place(beside, 0.0), scale);
  double least = 0.0, most = 0.0;
  for (int i = 1; i <= 4000; ++i) {
    tip.move_to(place(beside, 4.0 * across * i / 4000.0), scale);
    if (i < 1000) continue;
    least = std::min(least, tip.tip().x.si);
    most = std::max(most, tip.tip().x.si);
  }
  // the wells beside the line are half a period off it; the spring draws the tip back
  EXPECT_NEAR(most - least, 0.22e-9, 0.02e-9);
}

TEST(LatticeTip, CountsASlipForEveryRowOfAFastHand) {
  const Energy scale = scale_of_row(LatticeKind::Hexagonal, row_amplitude(5.0));
  LatticeTip tip(LatticeKind::Hexagonal, kPeriod, kSpring);
  tip.land(place(0.0), scale);
  EXPECT_EQ(tip.move_to(place(2.9 * kPeriod.si), scale).slip_count, 2U);
}

TEST(LatticeTip, LetsGoWithoutALossWhereTheLoadFalls) {
  const Energy high = scale_of_row(LatticeKind::Hexagonal, row_amplitude(4.0));
  LatticeTip tip(LatticeKind::Hexagonal, kPeriod, kSpring);
  tip.land(place(0.0), high);
  pull(tip, place(0.0), place(20.5 * kPeriod.si), 400, high);
  const double held = tip.force().x.si;
  EXPECT_LT(held, -0.1e-9);
  for (int i = 399; i >= 0; --i) tip.move_to(place(20.5 * kPeriod.si), high * (i / 400.0));
  EXPECT_NEAR(magnitude(tip.force()).si, 0.0, 1e-18);
  EXPECT_NEAR(tip.stored().si, 0.0, 1e-30);
}

// The potential by its formula, written out.
double potential(LatticeKind kind, const LatticeTip& tip, const Sideways<Length>& support, Energy scale) {
  const double x = tip.tip().x.si, y = tip.tip().y.si, q = 2.0 * std::numbers::pi / kPeriod.si;
  double height = 1.0 - std::cos(q * x);
  if (kind == LatticeKind::Square) height += 1.0 - std::cos(q * y);
  if (kind == LatticeKind::Hexagonal) {
    const double across = q / std::numbers::sqrt3 * y;
    height = 3.0 - 2.0 * std::cos(q * x) * std::cos(across) - std::cos(2.0 * across);
  }
  const double dx = x - support.x.si, dy = y - support.y.si;
  return scale.si * height + 0.5 * kSpring.si * (dx * dx + dy * dy);
}

// A tip that moves, and the cost of its path: -F . dX + v dU.
struct Traveller {
  LatticeTip tip;
  Sideways<Length> at;
  Energy scale;

  LatticeTip::Step go(double share, const Sideways<Length>& to, Energy to_scale) {
    at = at + (to - at) * share;
    scale = scale + (to_scale - scale) * share;
    return tip.move_to(at, scale);
  }
  double power(const Sideways<Length>& way, Energy rise) const {
    return -dot(tip.force(), way).si + tip.relief() * rise.si;
  }
};

// The work of a straight way on which the tip does not slip, by Gauss's rule: a copy of the tip is led to each node.
// Pieces are halved until the sum is exact to some 1e-13 of it.
double work_of_force(const Traveller& from, const Sideways<Length>& to, Energy to_scale, int depth = 0) {
  constexpr std::array kNodes{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array kWeights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                0.2369268850561891};
  const auto sum = [&](const Traveller& begin, const Sideways<Length>& end, Energy end_scale) {
    double work = 0.0;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      Traveller node = begin;
      node.go(0.5 * (1.0 + kNodes[i]), end, end_scale);
      work += 0.5 * kWeights[i] * node.power(end - begin.at, end_scale - begin.scale);
    }
    return work;
  };
  Traveller middle = from;
  middle.go(0.5, to, to_scale);
  const double whole = sum(from, to, to_scale);
  const double halves = sum(from, middle.at, middle.scale) + sum(middle, to, to_scale);
  if (std::abs(whole - halves) < 1e-34 || depth == 40) return halves;
  return work_of_force(from, middle.at, middle.scale, depth + 1) + work_of_force(middle, to, to_scale, depth + 1);
}

// 10^5 closed paths of three to five straight ways each, with a load that changes along them: the hand pays what the
// potential rises by and what the slips lose, never less. Of every 50th the work is the sum of the forces.
TEST(LatticeTip, NeverGivesEnergyOnAClosedPath) {
  std::mt19937_64 random(19);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int with_slips = 0, by_force = 0;
  for (int path = 0; path < support::draws(100'000); ++path) {
    const auto kind = static_cast<LatticeKind>(path % 3);
    const Energy full = scale_of_row(kind, row_amplitude(6.0));
    const auto anywhere = [&] {
      const double x_m = (share(random) - 0.5) * 1.6 * kPeriod.si;
      return std::pair{place(x_m, (share(random) - 0.5) * 1.6 * kPeriod.si), full * share(random)};
    };
    const auto [start, start_scale] = anywhere();
    Traveller traveller{LatticeTip(kind, kPeriod, kSpring), start, start_scale};
    traveller.tip.land(start, start_scale);
    const double begun = potential(kind, traveller.tip, start, start_scale);
    double lost = 0.0, work = 0.0, all = 0.0;
    std::uint32_t slips = 0;
    const int ways = 3 + path % 3;
    for (int way = 0; way < ways; ++way) {
      const auto [to, to_scale] = way == ways - 1 ? std::pair{start, start_scale} : anywhere();
      for (int i = 4; i >= 1; --i) {
        const Traveller before = traveller;
        const double held = traveller.tip.stored().si;
        const auto step = traveller.go(1.0 / i, to, to_scale);
        const double after = potential(kind, traveller.tip, traveller.at, traveller.scale);
        ASSERT_NEAR(after, traveller.tip.stored().si, 1e-13 * full.si);
        ASSERT_EQ(step.given, Energy());
        for (const LatticeSlip& slip : step.slipped()) ASSERT_GT(slip.lost.si, 0.0) << path;
        double paid = after - held + step.lost.si;
        if (path % 50 == 0 && step.lost.si == 0.0) {
          const double by_forces = work_of_force(before, traveller.at, traveller.scale);
          ASSERT_NEAR(by_forces, paid, 1e-12 * full.si) << path;
          paid = by_forces;
          ++by_force;
        }
        work += paid;
        all += std::abs(paid);
        lost += step.lost.si;
        slips += step.slip_count;
      }
    }
    // on the way back, perhaps in another well: the difference of the stored energies belongs to the balance
    const double gained = potential(kind, traveller.tip, start, start_scale) - begun - work;
    ASSERT_LE(gained, 1e-12 * all) << path;
    if (slips > 0) {
      ++with_slips;
      ASSERT_GT(lost, 0.0) << path;
      ASSERT_LT(gained, 0.0) << path;
    }
  }
  EXPECT_GT(with_slips, support::draws(30'000));
  EXPECT_GT(by_force, support::draws(10'000));
}

}  // namespace lattice_tip_test
}  // namespace afm::physics
