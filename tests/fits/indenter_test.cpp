// SPDX-License-Identifier: Apache-2.0
// Invariant: a fit finds the modulus of a computed curve to 1e-6 for every shape
#include "fits/indenter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace afm::fits {
namespace indenter_test {

constexpr double kDegree = std::numbers::pi / 180.0;

// Newtons for a reduced modulus of 4 kPa.
double force_n(const Indenter& indenter, double depth_m) { return 4000.0 * push_of(indenter, depth_m).force; }

// The numbers of Sneddon's sphere by bisection in 50 digits: those of the lab's cases P03 to P05 were computed with a
// contact radius that is exact to 2 pm only, and differ by up to 3e-7.
TEST(Indenter, SphereIsSneddons) {
  const Indenter sphere{.shape = Shape::Sphere, .radius_m = 5e-6};
  const Indenter paraboloid{.shape = Shape::Paraboloid, .radius_m = 5e-6};
  EXPECT_NEAR(force_n(sphere, 1.5e-6), 2.12497556584933e-08, 1e-12 * 2e-8);
  EXPECT_NEAR(force_n(sphere, 2.5e-6), 4.47743204694303e-08, 1e-12 * 4e-8);
  EXPECT_NEAR(force_n(sphere, 5e-6), 1.19967864025773e-07, 1e-12 * 1e-7);
  EXPECT_NEAR(force_n(sphere, 1.5e-6) / 2.124976174e-08, 1.0, 4e-7) << "P03";
  EXPECT_NEAR(force_n(paraboloid, 5e-6) / force_n(sphere, 5e-6), 1.111408764, 1e-7) << "P05";
  // the series below R/100 joins the formula above it
  const double below = force_n(sphere, 0.00999999 * 5e-6), above = force_n(sphere, 0.01000001 * 5e-6);
  EXPECT_NEAR(above / below, std::pow(0.01000001 / 0.00999999, 1.5), 2e-8);
}

TEST(Indenter, ConeAndPyramidsAreThoseOfTheirSources) {
  const auto sharp = [](Shape shape, double degrees) {
    return force_n({.shape = shape, .half_angle_rad = degrees * kDegree}, 1e-6);
  };
  EXPECT_NEAR(sharp(Shape::Cone, 25.0), 1.187442701e-09, 1e-18) << "P07";
  EXPECT_NEAR(sharp(Shape::Pyramid3, 20.0), 1.293841389e-09, 1e-18) << "P08";
  EXPECT_NEAR(sharp(Shape::Pyramid4Bilodeau, 20.0), 1.085068062e-09, 1e-18) << "P08";
  EXPECT_NEAR(sharp(Shape::Pyramid4Rico, 20.0), 1.029463283e-09, 1e-18) << "P08";
}

TEST(Indenter, LayersStiffenAsTheirFormulasSay) {
  const double radius_m = 5e-6, depth_m = 100e-9;
  const double thick = push_of({.shape = Shape::Paraboloid, .radius_m = radius_m}, depth_m).force;
  const auto sphere = [&](Shape shape, double strain) {
    const double layer_m = std::sqrt(radius_m * depth_m) / strain;
    return push_of({.shape = shape, .radius_m = radius_m, .layer_m = layer_m}, depth_m).force / thick;
  };
  struct Row {
    const char* id;
    double strain, exact, dimitriadis, garcia;
  };
  for (const Row& row : {Row{"P09", 0.09621718018, 1.123544397, 1.121585099, 1.124246136},
                         Row{"P11", 0.4172068752, 1.857116758, 1.754814931, 1.862818451},
                         Row{"P12", 0.5543754078, 2.38120009, 2.162643767, 2.40977984},
                         Row{"P13", 0.7479408303, 3.37109831, 2.917416279, 3.535779759}}) {
    EXPECT_NEAR(sphere(Shape::LayerDimitriadis, row.strain), row.dimitriadis, 1e-6 * row.dimitriadis) << row.id;
    EXPECT_NEAR(sphere(Shape::LayerSphere, row.strain), row.garcia, 1e-6 * row.garcia) << row.id;
    if (row.strain < 0.5) {
      EXPECT_NEAR(sphere(Shape::LayerSphere, row.strain), row.exact, 0.01 * row.exact) << row.id;
    }
  }
  const double angle_rad = 25.0 * kDegree;
  const auto cone = [&](double strain) {
    const double layer_m = depth_m * std::tan(angle_rad) / strain;
    return push_of({.shape = Shape::LayerCone, .half_angle_rad = angle_rad, .layer_m = layer_m}, depth_m).force /
           push_of({.shape = Shape::Cone, .half_angle_rad = angle_rad}, depth_m).force;
  };
  EXPECT_NEAR(cone(0.2802597311), 1.265318421, 1e-6) << "P17";
  EXPECT_NEAR(cone(0.8775573814), 2.598552163, 3e-6) << "P19";
  EXPECT_NEAR(cone(1.04781178), 3.305177329, 4e-6) << "P20";
}

TEST(Indenter, SlopeIsTheDerivativeOfTheForce) {
  for (const ShapeRow& row : kShapes) {
    if (row.is_adhesive) continue;
    const auto table = row.is_exact ? exact_table(row.shape, Base::Sliding, 0.3) : nullptr;
    const Indenter indenter{
        .shape = row.shape, .radius_m = 2e-6, .half_angle_rad = 0.4, .layer_m = 3e-6, .table = table};
    for (const double depth_m : {1e-12, 1e-9, 15e-9, 25e-9, 1e-7, 3e-6, 2e-5}) {
      const double step_m = 1e-5 * depth_m;
      const double up = push_of(indenter, depth_m + step_m).force, down = push_of(indenter, depth_m - step_m).force;
      const double slope = push_of(indenter, depth_m).slope;
      EXPECT_NEAR((up - down) / (2.0 * step_m), slope, 1e-6 * slope) << row.name << " at " << depth_m;
    }
    EXPECT_EQ(push_of(indenter, 0.0).force, 0.0) << row.name;
    EXPECT_EQ(push_of(indenter, -1e-9).force, 0.0) << row.name;
    EXPECT_EQ(push_of(indenter, std::nan("")).force, 0.0) << row.name;
    EXPECT_EQ(&row_of(row.shape), &row);
  }
}

}  // namespace indenter_test
}  // namespace afm::fits
