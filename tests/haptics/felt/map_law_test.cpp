// SPDX-License-Identifier: Apache-2.0
// A law that changes over the sample, by interpolated potentials.
// Invariant: no closed path over a map of modulus and adhesion gains energy
#include "haptics/map_law.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <random>
#include <vector>

#include "physics/law_tables.h"
#include "support/deep.h"

namespace afm::haptics {
namespace map_law_test {

using physics::Law;
using physics::Phase;

constexpr double kTopM = 0.06;  // height above every jump
constexpr double kHandMPerM = 1.5e5, kHandNPerN = 4e6;
constexpr std::size_t kColumns = 4, kRows = 3;

// Force on the hand as on a scale that bends: odd and monotone, and not the tip's times a factor.
double on_hand(double tip_n) { return 0.8 * std::asinh(kHandNPerN * tip_n); }

// Moduli from 1 MPa in factors of 8 along a row; works of adhesion from 20 mJ/m2 in factors of 2 up a column, with the
// attraction before contact.
MapLaw::Law law_of(Law name, std::size_t column, std::size_t row) {
  physics::ContactParameters contact;
  contact.tip_radius = physics::Length(30e-9);
  contact.spring_constant = physics::Stiffness(0.2);
  contact.sample_stiffness = physics::Stiffness(HUGE_VAL);
  contact.hamaker = physics::Energy(3e-20 * std::pow(2.0, static_cast<double>(row)));  // factor that moves the jump in
  contact.mean_surface_energy = physics::SurfaceEnergy(0.01 * std::pow(2.0, static_cast<double>(row)));
  contact.reduced_modulus = physics::Pressure(1e6 * std::pow(8.0, static_cast<double>(column)));
  const auto tables = physics::build_law_tables(name, contact);
  const auto felt = [tables](const physics::BranchTable& branch) {
    return
        [tables, &branch](double height_m) { return on_hand(branch.force(physics::Length(height_m / kHandMPerM)).si); };
  };
  return {felt(tables->free), felt(tables->attached), kHandMPerM * tables->figures.z_jtc.si,
          kHandMPerM * tables->figures.z_joc.si};
}

std::vector<MapLaw::Law> family_of(Law name) {
  std::vector<MapLaw::Law> laws;
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t column = 0; column < kColumns; ++column) laws.push_back(law_of(name, column, row));
  }
  return laws;
}

const MapLaw& map_of(Law name) {
  static const auto make = [](Law law) { return MapLaw(family_of(law), kColumns, {-0.03, 0.08}); };
  static const MapLaw dmt = make(Law::Dmt), jkr = make(Law::Jkr);
  return name == Law::Dmt ? dmt : jkr;
}

// A smooth random map that also goes beyond the family: its coordinates at each place of the hand.
class Terrain {
 public:
  explicit Terrain(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (Wave& wave : waves_) {
      wave = {.per_m = glm::dvec2{150.0 * number(random), 150.0 * number(random)},
              .phase = 3.0 * number(random),
              .size = glm::dvec2{1.2 * number(random), 0.9 * number(random)}};
    }
  }

  MapLaw::Place at(const glm::dvec2& xy_m) const {
    MapLaw::Place place{.at = glm::dvec2(0.5 * (kColumns - 1), 0.5 * (kRows - 1))};
    for (const Wave& wave : waves_) {
      const double angle = glm::dot(wave.per_m, xy_m) + wave.phase;
      place.at += std::sin(angle) * wave.size;
      place.column_slope += std::cos(angle) * wave.size.x * wave.per_m;
      place.row_slope += std::cos(angle) * wave.size.y * wave.per_m;
    }
    return place;
  }

 private:
  struct Wave {
    glm::dvec2 per_m{0.0};
    double phase = 0;
    glm::dvec2 size{0.0};
  };
  std::array<Wave, 3> waves_;
};

// Integral from 0 to 1 in equal parts, each halved until it is exact: it also finds kinks, all that differ among the
// five places of a part.
double integral(const std::function<double(double)>& f, double tolerance, int parts) {
  const std::function<double(double, double, double, double, double, int)> part =
      [&](double from, double to, double first, double middle, double last, int depth) -> double {
    const double half = 0.5 * (from + to), whole = (to - from) / 6.0 * (first + 4.0 * middle + last);
    const double left = f(0.5 * (from + half)), right = f(0.5 * (half + to));
    const double halves = (to - from) / 12.0 * (first + 4.0 * left + 2.0 * middle + 4.0 * right + last);
    if (depth == 0 || std::abs(halves - whole) < tolerance * (to - from)) return halves + (halves - whole) / 15.0;
    return part(from, half, first, left, middle, depth - 1) + part(half, to, middle, right, last, depth - 1);
  };
  double sum = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double from = i / static_cast<double>(parts), to = (i + 1) / static_cast<double>(parts);
    sum += part(from, to, f(from), f(0.5 * (from + to)), f(to), 30);
  }
  return sum;
}

// The hand on a map: work that it gets on straight ways.
class Hand {
 public:
  Hand(const MapLaw& law, const Terrain& terrain, bool sideways, double tolerance_j)
      : law_(law), terrain_(terrain), sideways_(sideways), tolerance_j_(tolerance_j) {}

  double work_on(Phase phase, const glm::dvec3& from_m, const glm::dvec3& to_m, int parts = 64) const {
    const glm::dvec3 way_m = to_m - from_m;
    return integral(
        [&](double share) {
          const glm::dvec3 at_m = from_m + share * way_m;
          const MapLaw::Felt felt = law_.at(phase, terrain_.at(glm::dvec2(at_m)), at_m.z);
          return felt.force_n * way_m.z + (sideways_ ? glm::dot(felt.sideways_n, glm::dvec2(way_m)) : 0.0);
        },
        tolerance_j_, parts);
  }

  // Work with all jumps on the way, each at its place.
  double work_with_jumps(Phase& phase, const glm::dvec3& from_m, const glm::dvec3& to_m, int& jumps) const {
    constexpr int kSteps = 50, kParts = 8;
    double work_j = 0.0;
    glm::dvec3 before_m = from_m;
    for (int i = 1; i <= kSteps; ++i) {
      const glm::dvec3 after_m = from_m + (i / static_cast<double>(kSteps)) * (to_m - from_m);
      if (next(phase, after_m) == phase) {
        work_j += work_on(phase, before_m, after_m, kParts);
      } else {
        double low = 0.0, high = 1.0;
        while (high - low > 1e-13) {
          const double middle = 0.5 * (low + high);
          (next(phase, before_m + middle * (after_m - before_m)) == phase ? low : high) = middle;
        }
        const glm::dvec3 jump_m = before_m + high * (after_m - before_m);
        work_j += work_on(phase, before_m, jump_m, kParts);
        phase = next(phase, jump_m);
        ++jumps;
        work_j += work_on(phase, jump_m, after_m, kParts);
      }
      before_m = after_m;
    }
    return work_j;
  }

 private:
  Phase next(Phase phase, const glm::dvec3& at_m) const {
    return law_.next_phase(phase, terrain_.at(glm::dvec2(at_m)), at_m.z);
  }

  const MapLaw& law_;
  const Terrain& terrain_;
  bool sideways_;
  double tolerance_j_;
};

// Largest energy that the law stores between the lowest height of the paths and the top.
double largest_j(const MapLaw& law) {
  double largest = 0.0;
  for (double column = 0.0; column < kColumns; column += 1.0) {
    for (double height_m = -0.02; height_m < kTopM; height_m += 1e-3) {
      for (const Phase phase : {Phase::Free, Phase::Attached}) {
        largest = std::max(largest, std::abs(law.at(phase, {.at = {column, 1.0}}, height_m).energy_j));
      }
    }
  }
  return largest;
}

constexpr int kPathsOfOneMap = 100;

// Largest energy of any of so many triangles on one branch, each on one of several maps.
double largest_gain_j(const MapLaw& law, Phase phase, bool sideways, int paths) {
  const double tolerance_j = 1e-8 * largest_j(law);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> across(-0.04, 0.04), rise(-2e-3, 2e-3), height(-0.015, 0.04);
  double largest = 0.0;
  for (int i = 0; i < paths; ++i) {
    const Terrain terrain(static_cast<unsigned>(i / kPathsOfOneMap));
    const Hand hand(law, terrain, sideways, tolerance_j);
    const double height_m = height(random);
    const auto corner = [&] { return glm::dvec3{across(random), across(random), height_m + rise(random)}; };
    const glm::dvec3 a = corner(), b = corner(), c = corner();
    const double gain_j = hand.work_on(phase, a, b) + hand.work_on(phase, b, c) + hand.work_on(phase, c, a);
    largest = std::max(largest, std::abs(gain_j));
  }
  return largest;
}

TEST(MapLaw, GivesNoEnergyOnAnyOfTenThousandClosedPaths) {
  struct Paths {
    Law law;
    Phase phase;
    int count;
  };
  // JKR's free branch has no force
  for (const Paths& paths : {Paths{Law::Dmt, Phase::Free, 2000}, Paths{Law::Dmt, Phase::Attached, 4000},
                             Paths{Law::Jkr, Phase::Attached, 4000}}) {
    const MapLaw& law = map_of(paths.law);
    EXPECT_LT(largest_gain_j(law, paths.phase, true, support::draws(paths.count)), 1e-6 * largest_j(law));
  }
}

TEST(MapLaw, WouldGiveEnergyWithoutItsSidewaysForce) {
  EXPECT_GT(largest_gain_j(map_of(Law::Dmt), Phase::Attached, false, 20), 1e-2 * largest_j(map_of(Law::Dmt)));
}

TEST(MapLaw, GivesNoEnergyOnPathsWithJumps) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> across(-0.04, 0.04), height(-0.01, 0.05);
  int jumps = 0;
  for (const Law name : {Law::Dmt, Law::Jkr}) {
    const MapLaw& law = map_of(name);
    const double most_j = largest_j(law);
    for (int i = 0; i < support::draws(300); ++i) {
      const Terrain terrain(static_cast<unsigned>(i));
      const Hand hand(law, terrain, true, 1e-8 * most_j);
      const glm::dvec3 start{across(random), across(random), kTopM};
      Phase phase = Phase::Free;
      double work_j = 0.0;
      glm::dvec3 at = start;
      for (int k = 0; k < 4; ++k) {
        const glm::dvec3 next{across(random), across(random), height(random)};
        work_j += hand.work_with_jumps(phase, at, next, jumps);
        at = next;
      }
      work_j += hand.work_with_jumps(phase, at, {at.x, at.y, kTopM}, jumps);
      work_j += hand.work_with_jumps(phase, {at.x, at.y, kTopM}, start, jumps);
      ASSERT_EQ(phase, Phase::Free);
      EXPECT_LT(work_j, 1e-6 * most_j) << "path " << i;
    }
  }
  EXPECT_GT(jumps, support::draws(600)) << "the paths hardly ever touch";
}

TEST(MapLaw, IsTheOutermostLawBeyondTheFamily) {
  const MapLaw& law = map_of(Law::Jkr);
  const MapLaw::Law own = law_of(Law::Jkr, kColumns - 1, 0);
  const MapLaw::Place place{.at = {kColumns - 0.5, -0.5}};
  EXPECT_DOUBLE_EQ(law.jump_in_m(place), own.jump_in_m);
  EXPECT_DOUBLE_EQ(law.jump_off_m(place), own.jump_off_m);
  for (double height_m = -0.02; height_m < kTopM; height_m += 1.37e-3) {
    const double free_n = own.free_n(std::max(height_m, own.jump_in_m)),
                 attached_n = own.attached_n(std::min(height_m, own.jump_off_m));
    EXPECT_NEAR(law.at(Phase::Free, place, height_m).force_n, free_n, 1e-3) << height_m;
    EXPECT_NEAR(law.at(Phase::Attached, place, height_m).force_n, attached_n, 1e-2) << height_m;
  }
}

TEST(MapLaw, HasOneEnergyAtTheJumpInAndNoMoreAfterTheJumpOffAnywhere) {
  for (const Law name : {Law::Dmt, Law::Jkr}) {
    const MapLaw& law = map_of(name);
    for (double column = -0.5; column < kColumns; column += 0.23) {
      for (double row = -0.5; row < kRows; row += 0.31) {
        const MapLaw::Place place{.at = {column, row}};
        const double in_m = law.jump_in_m(place), off_m = law.jump_off_m(place);
        EXPECT_NEAR(law.at(Phase::Attached, place, in_m).energy_j, law.at(Phase::Free, place, in_m).energy_j, 1e-15);
        EXPECT_LE(law.at(Phase::Free, place, off_m).energy_j, law.at(Phase::Attached, place, off_m).energy_j + 1e-15);
        EXPECT_EQ(law.next_phase(Phase::Attached, place, off_m + 1e-9), Phase::Free);
      }
    }
  }
}

// Reference case M01, with 20 mm and 1 N of the hand for 2 nm and 1 nN of the tip.
TEST(MapLaw, PaysWithItsSidewaysForceForAStifferPlace) {
  constexpr double kMPerM = 1e7, kNPerN = 1e9, kJPerJ = kMPerM * kNPerN, kDepthM = 2e-9, kRadiusM = 20e-9;
  const auto hertz = [](double reduced_pa) {
    const auto force_n = [reduced_pa](double height_m) {
      return kNPerN * 4.0 / 3.0 * reduced_pa * std::sqrt(kRadiusM) * std::pow(std::max(-height_m / kMPerM, 0.0), 1.5);
    };
    return MapLaw::Law{force_n, force_n, 0.0, 0.0};
  };
  const MapLaw law({hertz(1e9), hertz(3e9)}, 2, {-0.03, 0.08});
  const auto at = [&](double column) {
    return law.at(Phase::Attached, {.at = {column, 0.0}, .column_slope = {1.0, 0.0}}, -kMPerM * kDepthM);
  };
  EXPECT_NEAR(at(-0.5).energy_j, 1.349238468e-17 * kJPerJ, 1e-4 * 1.349238468e-17 * kJPerJ);
  EXPECT_NEAR(at(1.5).energy_j, 4.047715405e-17 * kJPerJ, 1e-4 * 4.047715405e-17 * kJPerJ);
  double sideways_j = 0.0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) sideways_j += 2.0 / kSteps * at(-0.5 + 2.0 * (i + 0.5) / kSteps).sideways_n.x;
  // a hand that goes in at the soft place and out at the stiff one would gain as much
  EXPECT_NEAR(sideways_j, -2.698476937e-17 * kJPerJ, 1e-4 * 2.698476937e-17 * kJPerJ);
  EXPECT_NEAR(sideways_j, at(-0.5).energy_j - at(1.5).energy_j, 1e-12);
}

TEST(MapLaw, KeepsTheForceOfABranchBeyondItsJump) {
  const MapLaw law({{.free_n = [](double height_m) { return -10.0 * height_m; },
                     .attached_n = [](double height_m) { return -20.0 * height_m; },
                     .jump_in_m = 0.01,
                     .jump_off_m = 0.02}},
                   1, {-0.03, 0.08});
  EXPECT_NEAR(law.at(Phase::Free, {}, 0.005).force_n, -0.1, 1e-9);
  EXPECT_NEAR(law.at(Phase::Free, {}, 0.015).force_n, -0.15, 1e-9);
  EXPECT_NEAR(law.at(Phase::Attached, {}, 0.03).force_n, -0.4, 1e-9);
  EXPECT_NEAR(law.at(Phase::Attached, {}, 0.015).force_n, -0.3, 1e-9);
}

// Halfway between a law that holds the tip far below and one that pushes it where the other lets go.
TEST(MapLaw, HoldsTheTipWhereLettingGoWouldGiveEnergy) {
  const auto nothing = [](double) { return 0.0; };
  const MapLaw law({{nothing, [](double) { return -1.0; }, 0.0, 0.02},
                    {nothing, [](double height_m) { return height_m < 0.0305 ? 5.0 : -5.0; }, 0.03, 0.031}},
                   2, {-0.03, 0.08});
  const MapLaw::Place place{.at = {0.5, 0.0}};
  const double off_m = law.jump_off_m(place);
  ASSERT_LT(law.at(Phase::Attached, place, off_m).energy_j, law.at(Phase::Free, place, off_m).energy_j);
  double height_m = off_m;
  while (law.next_phase(Phase::Attached, place, height_m) == Phase::Attached && height_m < kTopM) height_m += 1e-5;
  EXPECT_GT(height_m, off_m + 0.005);
  ASSERT_LT(height_m, kTopM) << "it never lets go";
  EXPECT_GE(law.at(Phase::Attached, place, height_m).energy_j, law.at(Phase::Free, place, height_m).energy_j);
}

TEST(MapLaw, ContinuesFlatBeyondItsEdges) {
  const MapLaw& law = map_of(Law::Dmt);
  const glm::dvec2 slope(100.0, -50.0);
  for (const glm::dvec2& outside : {glm::dvec2(-0.7, 1.5), glm::dvec2(kColumns + 3.0, 1.5)}) {
    const glm::dvec2 edge(std::clamp(outside.x, -0.5, kColumns - 0.5), outside.y);
    const MapLaw::Place place{.at = outside, .column_slope = slope, .row_slope = {0.0, 0.0}};
    const MapLaw::Felt beyond = law.at(Phase::Attached, place, -0.01),
                       there = law.at(Phase::Attached, {.at = edge}, -0.01);
    EXPECT_EQ(beyond.energy_j, there.energy_j);
    EXPECT_EQ(beyond.force_n, there.force_n);
    EXPECT_EQ(beyond.sideways_n, glm::dvec2(0.0));
  }
  const MapLaw::Felt inside = law.at(Phase::Attached, {.at = {1.5, 1.5}, .column_slope = slope}, -0.01);
  EXPECT_GT(glm::length(inside.sideways_n), 0.01) << "as light as a hand can feel";
}

TEST(MapLaw, IsContinuousAcrossTheBordersOfItsLaws) {
  const MapLaw& law = map_of(Law::Jkr);
  for (const Phase phase : {Phase::Free, Phase::Attached}) {
    for (const double height_m : {-0.01, 0.0, 0.01, 0.03}) {
      const auto at = [&](double column) {
        return law.at(phase, {.at = {column, 0.7}, .column_slope = {1.0, 0.0}}, height_m);
      };
      for (double border = -0.5; border < kColumns; border += 1.0) {
        EXPECT_NEAR(at(border - 1e-9).energy_j, at(border + 1e-9).energy_j, 1e-9);
        EXPECT_NEAR(at(border - 1e-9).force_n, at(border + 1e-9).force_n, 1e-7);
        EXPECT_NEAR(at(border - 1e-9).sideways_n.x, at(border + 1e-9).sideways_n.x, 1e-7);
      }
    }
  }
}

TEST(MapLaw, WaitsForALiftWithoutForce) {
  const MapLaw& law = map_of(Law::Jkr);
  const MapLaw::Place place{.at = {1.3, 0.4}, .column_slope = {10.0, 0.0}};
  const MapLaw::Felt felt = law.at(Phase::WaitForLift, place, -0.01);
  EXPECT_EQ(felt.force_n, 0.0);
  EXPECT_EQ(felt.sideways_n, glm::dvec2(0.0));
  const double off_m = law.jump_off_m(place);
  EXPECT_EQ(law.next_phase(Phase::WaitForLift, place, off_m), Phase::WaitForLift);
  EXPECT_EQ(law.next_phase(Phase::WaitForLift, place, off_m + 1e-6), Phase::Free);
}

}  // namespace map_law_test
}  // namespace afm::haptics
