// SPDX-License-Identifier: Apache-2.0
// Closed forms of the table of cases for marks in a soft surface.
#include "physics/manipulation/marking.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "physics/contact_parameters.h"
#include "physics/manipulation/marked_surface.h"
#include "scratching.h"

namespace afm::physics {
namespace marking_test {

using namespace literals;
using test::expect_relative;
using test::flank_tip;
using test::marking_tip;
using test::pmma;

constexpr double kClosed = 1e-6;  // relative tolerance of the table

TEST(Marking, N59TheImprintOfAStandingTip) {
  const Length depth = imprint_depth(marking_tip(), pmma(), 50_nN), radius = imprint_radius(pmma(), 50_nN);
  expect_relative(depth.si, 1.373450338e-09, kClosed);
  expect_relative(radius.si, 7.283656204e-09, kClosed);
  expect_relative(TipOutline(marking_tip()).radius_at(depth).si, radius.si, 1e-12);
  expect_relative((depth - spring_back(pmma(), 50_nN, radius)).si, 6.244259182e-10, kClosed);
}

TEST(Marking, N60TheGrooveOfADraggedTip) {
  expect_relative(groove_depth(marking_tip(), pmma(), 100_nN).si, 6.296226461e-09, kClosed);
  expect_relative(2.0 * groove_radius(pmma(), 100_nN).si, 2.913462482e-08, kClosed);
  expect_relative(cap_load(marking_tip(), pmma()).si, 1.664457675e-07, kClosed);
}

TEST(Marking, N62TheForceOfAGroove) {
  const Length depth = groove_depth(marking_tip(), pmma(), 100_nN);
  const Area section = groove_section(marking_tip(), depth);
  expect_relative(section.si, 1.267462969e-16, kClosed);
  expect_relative(section / (0.5 * tip_area(marking_tip(), depth)), 0.3802388906, kClosed);
  expect_relative((pmma().hardness * section).si, 3.802388906e-08, kClosed);
}

// Sideways force over the load, (2/pi) cot(half angle) (M55), in a groove so deep that the cap does not count.
TEST(Marking, N63TheCoefficientOfACone) {
  struct Cone {
    double half_angle_deg, coefficient;
  };
  for (const Cone& cone : {Cone{20.0, 1.749098449}, Cone{35.0, 0.909187259}, Cone{70.0, 0.2317106477}}) {
    const SphereCone tip = flank_tip(1_nm, cone.half_angle_deg);
    const Length deep = 100_um;
    expect_relative(groove_section(tip, deep) / (0.5 * tip_area(tip, deep)), cone.coefficient, 1e-4);
  }
}

TEST(Marking, N64TheRidgesOfAGroove) {
  const Length depth = groove_depth(marking_tip(), pmma(), 100_nN);
  const Length height = ridge_height(groove_section(marking_tip(), depth), 0.7, 2.0 * groove_radius(pmma(), 100_nN));
  expect_relative(height.si, 4.567884864e-09, kClosed);
}

TEST(Marking, N66AnyTouchMarksPmma) {
  expect_relative(touching_pressure(marking_tip(), pmma()).si, 556491010.7, kClosed);
  expect_relative(yield_pressure(pmma()).si, 160000000.0, kClosed);
  SoftSurface clean = pmma();
  clean.work_of_adhesion = SurfaceEnergy(0.0);
  EXPECT_EQ(touching_pressure(marking_tip(), clean).si, 0.0);
}

// The section is the integral of the width over the depth, on the cap and on the cone.
TEST(Marking, SectionsAreIntegralsOfTheWidth) {
  const TipOutline outline(marking_tip());
  for (const double depth_m : {1e-9, 13e-9, 14e-9, 60e-9}) {
    double sum = 0.0;
    constexpr int kSteps = 200'000;
    for (int i = 0; i < kSteps; ++i) {
      sum += 2.0 * outline.radius_at(Length((i + 0.5) / kSteps * depth_m)).si * depth_m / kSteps;
    }
    expect_relative(groove_section(marking_tip(), Length(depth_m)).si, sum, 1e-6);
    expect_relative(outline.height_at(outline.radius_at(Length(depth_m))).si, depth_m, 1e-12);
  }
}

TEST(Marking, AnImprintBelowTheLeastLoadSpringsBack) {
  const Force least = least_marking_load(marking_tip(), pmma());
  const auto stays = [](Force load) {
    return (imprint_depth(marking_tip(), pmma(), load) - spring_back(pmma(), load, imprint_radius(pmma(), load))).si;
  };
  EXPECT_NEAR(stays(least), 0.0, 1e-18);
  EXPECT_LT(stays(0.9 * least), 0.0);
  EXPECT_GT(stays(1.1 * least), 0.0);
}

TEST(Marking, RefusesWhatDoesNotFlow) {
  const auto refused = [](const auto& change, const char* field) {
    SoftSurface surface = pmma();
    change(surface);
    try {
      validate(surface);
      ADD_FAILURE() << field << " was accepted";
    } catch (const UnphysicalValue& error) {
      EXPECT_EQ(error.field(), field);
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](SoftSurface& s) { s.hardness = Pressure(0.0); }, "hardness");
  refused([&](SoftSurface& s) { s.hardness = Pressure(nan); }, "hardness");
  refused([](SoftSurface& s) { s.hardness = Pressure(0.8e9); }, "sample_modulus");
  refused([](SoftSurface& s) { s.pile_up_share = 1.1; }, "pile_up_share");
  refused([](SoftSurface& s) { s.work_of_adhesion = SurfaceEnergy(-0.1); }, "work_of_adhesion");
  EXPECT_THROW(validate_marking_tip(flank_tip(20_nm, 2.0)), UnphysicalValue);
  EXPECT_THROW(validate_marking_tip(flank_tip(20_nm, 75.0)), UnphysicalValue);
  EXPECT_NO_THROW(validate(pmma()));
}

}  // namespace marking_test
}  // namespace afm::physics
