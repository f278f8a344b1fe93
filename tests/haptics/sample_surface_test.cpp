// SPDX-License-Identifier: Apache-2.0
// Invariant: the force on a rough sample is continuous on a branch; its events are exact everywhere
#include "haptics/sample_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <string>

#include "scene/gltf/gltf_loader.h"
#include "scene/graph/height_field.h"
#include "support/places.h"
#include "support/samples/measured_surface.h"
#include "support/samples/rough_surface.h"

namespace sample_surface_test {

using namespace afm::haptics;
using afm::scene::SharedHeightField;
using afm::test::rough_surface;

constexpr double kRadius = 50e-9;
constexpr double kAnyCurvature = std::numeric_limits<double>::infinity();
constexpr double kGentle = 0.1e9;  // limit in 1/m for a hand of 400 N/m

double coordinate(const SharedHeightField& field, std::uint32_t index) {
  return (index - 0.5 * (field.columns - 1)) * field.spacing_m;
}

double drawn(const SharedHeightField& field, std::uint32_t column, std::uint32_t row) {
  return static_cast<double>(field.height_m[row * field.columns + column]);
}

class FeltSurfaceOfARoughSample : public testing::TestWithParam<std::uint32_t> {
 protected:
  const SharedHeightField drawn_ = rough_surface(GetParam());
  const SampleSurface felt_{drawn_, kRadius, kGentle};
  const double half_ = 0.5 * (drawn_.columns - 1) * drawn_.spacing_m;
  std::mt19937 random_{GetParam()};

  glm::dvec2 anywhere(double reach) {
    std::uniform_real_distribution<double> place(-reach * half_, reach * half_);
    return {place(random_), place(random_)};
  }
};

TEST_P(FeltSurfaceOfARoughSample, HasTheSlopeOfItsHeight) {
  const double step = 1e-3 * drawn_.spacing_m;
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec2 xy = anywhere(1.2);
    const auto difference = [&](const glm::dvec2& d) {
      return (felt_.at(xy + d).height_m - felt_.at(xy - d).height_m) / (2.0 * step);
    };
    const auto place = felt_.at(xy);
    // a central difference across a knot of a quadratic spline is off by a curvature times the step
    ASSERT_NEAR(place.slope.x, difference({step, 0.0}), kGentle * step);
    ASSERT_NEAR(place.slope.y, difference({0.0, step}), kGentle * step);
  }
}

TEST_P(FeltSurfaceOfARoughSample, NeverJumpsOnAnyPath) {
  std::uniform_real_distribution<double> step(-0.3 * drawn_.spacing_m, 0.3 * drawn_.spacing_m);
  glm::dvec2 xy(0.0);
  auto before = felt_.at(xy);
  for (int i = 0; i < 50'000; ++i) {
    const glm::dvec2 next = glm::clamp(xy + glm::dvec2(step(random_), step(random_)), -1.3 * half_, 1.3 * half_);
    const auto here = felt_.at(next);
    const double distance = glm::length(next - xy);
    ASSERT_LE(std::abs(here.height_m - before.height_m), SampleSurface::kSteepestSlope * distance + 1e-20);
    ASSERT_LE(glm::length(here.slope - before.slope), kGentle * distance + 1e-12);
    xy = next;
    before = here;
  }
}

TEST_P(FeltSurfaceOfARoughSample, StaysWithinItsSlopeAndItsCurvature) {
  EXPECT_LE(felt_.steepest_slope(), SampleSurface::kSteepestSlope);
  EXPECT_LE(felt_.largest_curvature_per_m(), kGentle);
  for (int i = 0; i < 20'000; ++i) ASSERT_LE(glm::length(felt_.at(anywhere(1.5)).slope), felt_.steepest_slope());
}

TEST_P(FeltSurfaceOfARoughSample, IsTheDrawnOneAtTheOrigin) { EXPECT_NEAR(felt_.at({0.0, 0.0}).height_m, 0.0, 1e-20); }

TEST_P(FeltSurfaceOfARoughSample, IsWhatABallTraces) {
  // the height at which a paraboloid of the tip's radius, its apex over xy, touches the drawn surface
  const auto touching_m = [&](const glm::dvec2& xy) {
    double highest = -1.0;
    for (std::uint32_t row = 0; row < drawn_.rows; ++row) {
      for (std::uint32_t column = 0; column < drawn_.columns; ++column) {
        const glm::dvec2 beside = glm::dvec2(coordinate(drawn_, column), coordinate(drawn_, row)) - xy;
        highest = std::max(highest, drawn(drawn_, column, row) - glm::dot(beside, beside) / (2.0 * kRadius));
      }
    }
    return highest;
  };
  constexpr double kRounding = 0.05e-9;  // crease rounded by the spline: an eighth of its change of slope in a spacing
  const SampleSurface traced(drawn_, kRadius, kAnyCurvature);
  const double at_origin_m = touching_m({0.0, 0.0});
  double deepest_dent_m = 0.0;
  for (std::uint32_t row = 2; row + 2 < drawn_.rows; row += 6) {
    for (std::uint32_t column = 2; column + 2 < drawn_.columns; column += 3) {
      const glm::dvec2 xy(coordinate(drawn_, column), coordinate(drawn_, row));
      const double touching = touching_m(xy);
      ASSERT_NEAR(traced.at(xy).height_m, touching - at_origin_m, 2.0 * kRounding);
      deepest_dent_m = std::max(deepest_dent_m, touching - drawn(drawn_, column, row));
    }
  }
  EXPECT_GT(deepest_dent_m, 0.5e-9) << "a surface without dents narrower than the tip";
}

TEST_P(FeltSurfaceOfARoughSample, GoesOverIntoOneLevelBeyondTheRim) {
  const double level = felt_.at({1.0, 1.0}).height_m, far = 10.0 * half_;
  double highest = 0.0;
  for (int i = 0; i < 400; ++i) {
    const double along = (i - 200) * far / 200.0;
    for (const glm::dvec2 place :
         {glm::dvec2(far, along), glm::dvec2(-far, along), glm::dvec2(along, far), glm::dvec2(along, -far)}) {
      ASSERT_EQ(felt_.at(place).height_m, level);
      ASSERT_EQ(felt_.at(place).slope, glm::dvec2(0.0));
    }
    highest = std::max(highest, std::abs(felt_.at({half_, 0.1 * along}).height_m - level));
  }
  EXPECT_GT(highest, 0.1e-9) << "an edge that is level by itself";
  for (int i = 0; i < 20'000; ++i) {
    const auto place = felt_.at(anywhere(8.0));
    ASSERT_LE(glm::length(place.slope), felt_.steepest_slope());
    ASSERT_TRUE(std::isfinite(place.height_m));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FeltSurfaceOfARoughSample, testing::Values(1U, 2U, 3U));

TEST(SampleSurface, WithoutASampleIsAPlane) {
  const auto place = SampleSurface().at({1e-8, -3e-8});
  EXPECT_EQ(place.height_m, 0.0);
  EXPECT_EQ(place.slope, glm::dvec2(0.0));
}

TEST(SampleSurface, IsFiniteWhateverItIsAsked) {
  const SampleSurface felt(rough_surface(4), kRadius, kGentle);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinity = std::numeric_limits<double>::infinity();
  for (const double strange : {kNan, kInfinity, -kInfinity, 1e308, -1e308}) {
    EXPECT_TRUE(std::isfinite(felt.at({strange, 0.0}).height_m));
    EXPECT_TRUE(std::isfinite(felt.at({0.0, strange}).slope.y));
  }
}

TEST(SampleSurface, RisesOverAStepAsWideAsTheBallIs) {
  SharedHeightField step;
  step.columns = step.rows = 129;
  step.spacing_m = 0.25e-9;
  for (std::uint32_t i = 0; i < step.columns * step.rows; ++i) step.height_m[i] = i % step.columns > 64 ? 1e-9F : 0.0F;
  // a ball of radius R first touches a step of h at sqrt(2 R h) from it: 10 nm
  const SampleSurface felt(step, kRadius, kAnyCurvature);
  const double floor_m = felt.at({-14e-9, 0.0}).height_m;
  EXPECT_NEAR(felt.at({-10.5e-9, 0.0}).height_m - floor_m, 0.0, 1e-12);
  EXPECT_NEAR(felt.at({-5e-9, 0.0}).height_m - floor_m, 1e-9 - 25e-18 / (2.0 * kRadius), 0.06e-9);
  EXPECT_NEAR(felt.at({2e-9, 0.0}).height_m - floor_m, 1e-9, 1e-12);
  EXPECT_NEAR(felt.steepest_slope(), std::sqrt(2.0 * 1e-9 / kRadius), 0.02);
}

// The samples that are drawn, under a tip of 50 nm, on the scales that they are felt on.
TEST(SampleSurface, OfTheDrawnSamplesFollowsThemAsATipDoes) {
  struct Expected {
    const char* model;
    double drawn_along_x, steepest_felt, mean_lift_nm;
  };
  for (const Expected& expected :
       {Expected{"mica", 0.6, 0.33, 0.6}, {"gold", 0.6, 0.41, 0.9}, {"si3n4", 1.3, 0.24, 0.6}}) {
    const auto scene = afm::scene::load_gltf(afm::support::source("assets/models/sample-") + expected.model + ".glb");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto field = afm::scene::height_field_below(*scene, scene->find_node("surface").value());
    ASSERT_TRUE(field);
    const SampleSurface felt(*field, kRadius, kAnyCurvature);
    double steepest = 0, lift = 0, lowest = 0;
    for (std::uint32_t row = 0; row < field->rows; ++row) {
      for (std::uint32_t column = 0; column < field->columns; ++column) {
        if (column > 0) {
          steepest = std::max(steepest, std::abs(drawn(*field, column, row) - drawn(*field, column - 1, row)));
        }
        const double above =
            felt.at({coordinate(*field, column), coordinate(*field, row)}).height_m - drawn(*field, column, row);
        lift += above / (field->rows * field->columns);
        lowest = std::min(lowest, above);
      }
    }
    EXPECT_GT(steepest / field->spacing_m, expected.drawn_along_x) << expected.model;
    EXPECT_LT(felt.steepest_slope(), expected.steepest_felt + 0.01) << expected.model;
    EXPECT_LT(lift, expected.mean_lift_nm * 1e-9) << expected.model;
    EXPECT_GT(lowest, -0.03e-9) << expected.model << ": the apex stands in the drawn surface";
    EXPECT_NEAR(felt.at({0.0, 0.0}).height_m, 0.0, 1e-20) << expected.model;
  }
}

// ---- a topography of the most points ----

class FeltTopography : public testing::Test {
 protected:
  const afm::scene::Topography measured_ = afm::test::measured_surface();
  const afm::scene::FeltHeights shown_{measured_, afm::test::kMeasuredScale};
  const SampleSurface felt_{shown_, kRadius, kGentle};
  std::mt19937 random_{7};
};

TEST_F(FeltTopography, StaysWithinItsSlopeAndItsCurvature) {
  EXPECT_LE(felt_.steepest_slope(), SampleSurface::kSteepestSlope);
  EXPECT_LE(felt_.largest_curvature_per_m(), kGentle);
  // and is smoothed no more than necessary
  EXPECT_GT(std::max(felt_.steepest_slope() / SampleSurface::kSteepestSlope, felt_.largest_curvature_per_m() / kGentle),
            0.75);
}

TEST_F(FeltTopography, HasTheSlopeOfItsHeight) {
  const double half = 0.6 * shown_.spacing_m * shown_.columns, step = 1e-3 * shown_.spacing_m;
  std::uniform_real_distribution<double> place(-half, half);
  for (int i = 0; i < 20'000; ++i) {
    const glm::dvec2 xy(place(random_), place(random_));
    const auto difference = [&](const glm::dvec2& d) {
      return (felt_.at(xy + d).height_m - felt_.at(xy - d).height_m) / (2.0 * step);
    };
    ASSERT_NEAR(felt_.at(xy).slope.x, difference({step, 0.0}), kGentle * step + 1e-7);
    ASSERT_NEAR(felt_.at(xy).slope.y, difference({0.0, step}), kGentle * step + 1e-7);
  }
}

TEST_F(FeltTopography, FollowsTheMeasuredHeightsAsFarAsItIsGentle) {
  const SampleSurface::Change change = felt_.change_of(shown_);
  const double relief_m = 1.5e-6 * afm::test::kMeasuredScale.vertical;
  EXPECT_LT(change.rms_m, 0.25 * relief_m);
  EXPECT_LT(change.rms_m, change.largest_m);
  EXPECT_NEAR(felt_.at({0.0, 0.0}).height_m, 0.0, 0.2e-9) << "within the noise of the four points around the origin";
}

TEST(SampleSurface, OfAGentleTopographyIsTheMeasuredOnePointByPoint) {
  afm::scene::Topography hill{.columns = 65, .rows = 65, .spacing_m = 2e-9, .height_m = {}};
  for (std::uint32_t i = 0; i < 65 * 65; ++i) {
    const double x = (i % 65 - 32.0) / 32.0, y = (i / 65 - 32.0) / 32.0;
    hill.height_m.push_back(static_cast<float>(1e-9 * (std::cos(3.0 * x) * std::cos(3.0 * y) - 1.0)));
  }
  const afm::scene::FeltHeights shown(hill, {1.0, 1.0});
  const SampleSurface felt(shown, kRadius, kGentle);
  // a quadratic spline rounds by an eighth of the second differences
  const double rounding_m = 0.25 * 1e-9 * 9.0 / (32.0 * 32.0);
  EXPECT_LT(felt.change_of(shown).largest_m, 4.0 * rounding_m) << "the tip's radius dilates no image";
  afm::scene::Topography cliff = hill;
  for (std::uint32_t i = 0; i < 65 * 65; ++i) cliff.height_m[i] = i % 65 > 32 ? 1e-3F : 0.0F;
  const SampleSurface smoothed(afm::scene::FeltHeights(cliff, {1.0, 1.0}), kRadius, kGentle);
  EXPECT_LE(smoothed.steepest_slope(), SampleSurface::kSteepestSlope) << "whatever it takes";
}

}  // namespace sample_surface_test
