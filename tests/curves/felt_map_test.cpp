// SPDX-License-Identifier: Apache-2.0
// Invariant: a fit that is not trusted is never felt as a number
#include "curves/fitting/felt_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

#include "curves/fitting/curve_fit.h"
#include "curves/live_parameters.h"
#include "scene/samples/material_library.h"
#include "scene/shared/shared_segment.h"
#include "support/archives/sticky_map.h"
#include "support/archives/stored_zip.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::curves {
namespace felt_map_test {

using fits::Trust;
using testing::HasSubstr;

constexpr double kRadiusM = 50e-9;

// A file with 3 x 2 curves, whose fits are ours.
class FeltMapTest : public ::testing::Test {
 protected:
  using FitAt = std::function<PixelFit(std::size_t column, std::size_t row)>;

  std::shared_ptr<const CurveMap> load(const FitAt& fit_at) const {
    const std::string file = folder_.write("gel.jpk-force-map", test::stored_zip(test::jpk_map(test::sticky_curve)));
    auto map = CurveMap::load(
        file, [](std::size_t, std::size_t) { return true; }, {},
        [&](const RecordedCurve& curve) { return fit_at(curve.metadata.pixel->column, curve.metadata.pixel->row); });
    EXPECT_TRUE(map) << map.error().message;
    return std::make_shared<const CurveMap>(std::move(*map));
  }

  static FitOptions jkr() {
    FitOptions options;
    options.shape = fits::Shape::Jkr;
    options.radius_m = kRadiusM;
    return options;
  }

  support::ScratchFolder folder_;
};

PixelFit trusted(double modulus_pa, double adhesion_j_per_m2) {
  return {
      .modulus_pa = modulus_pa, .adhesion_n = 5e-9, .adhesion_j_per_m2 = adhesion_j_per_m2, .trust = Trust::Trusted};
}

TEST_F(FeltMapTest, HasTheModuliOfItsFitsInTheirPlaces) {
  const auto map = load([](std::size_t column, std::size_t row) {
    return trusted(1e6 * (1.0 + static_cast<double>(column) + 3.0 * static_cast<double>(row)), 30e-3);
  });
  const auto felt = felt_map(*map, jkr());
  ASSERT_TRUE(felt) << felt.error().message;
  EXPECT_EQ(felt->law, physics::Law::Jkr);
  ASSERT_EQ(felt->laws.columns, 3U);
  ASSERT_EQ(felt->laws.rows, 2U);
  EXPECT_NEAR(felt->laws.spacing_m, 1e-6, 1e-12);
  for (std::size_t cell = 0; cell < 6; ++cell) {
    // rows from the bottom; E* for nu = 0.5
    EXPECT_NEAR(std::exp(static_cast<double>(felt->laws.ln_modulus[cell])), 1e6 * static_cast<double>(1 + cell) / 0.75,
                100.0);
    EXPECT_FLOAT_EQ(felt->laws.adhesion_j_per_m2[cell], 30e-3F);
  }
  EXPECT_EQ(felt->filled, 0U);
  EXPECT_TRUE(scene::is_valid(felt->laws));
  EXPECT_TRUE(scene::is_valid(felt->heights, felt->heights.size()));
  // each curve lies 10 nm above the one before it, on approach and retract
  EXPECT_NEAR(static_cast<double>(felt->heights.height_m[1] - felt->heights.height_m[0]), 10e-9, 1e-12);
  EXPECT_NEAR(static_cast<double>(felt->heights.height_m[3] - felt->heights.height_m[5]), 20e-9, 1e-12);
}

TEST_F(FeltMapTest, FillsWhatIsNotTrustedFromItsNeighbours) {
  const auto map = load([](std::size_t column, std::size_t row) {
    PixelFit fit = trusted(column == 2 ? 4e6 : 1e6, column == 2 ? 60e-3 : 20e-3);
    if (column == 1 && row == 0) {
      fit.modulus_pa = 1e12;
      fit.trust = Trust::No;
    }
    if (column == 1 && row == 1) fit.trust = Trust::Doubtful;
    return fit;
  });
  const auto felt = felt_map(*map, jkr());
  ASSERT_TRUE(felt) << felt.error().message;
  EXPECT_EQ(felt->filled, 1U);
  EXPECT_TRUE(felt->is_filled[4]) << "row by row from the top";
  EXPECT_FALSE(felt->is_filled[1]) << "doubtful is not untrusted";
  // between three of 1 MPa and two of 4 MPa
  EXPECT_NEAR(std::exp(static_cast<double>(felt->laws.ln_modulus[1])), std::pow(4.0, 0.4) * 1e6 / 0.75, 1e3);
  EXPECT_NEAR(static_cast<double>(felt->laws.adhesion_j_per_m2[1]), 36e-3, 1e-6);
  EXPECT_THAT(felt_text(*felt),
              HasSubstr("E 1 MPa to 4 MPa, W 20 mJ/m2 to 60 mJ/m2, law jkr; 1 of 6 pixels are filled"));
}

TEST_F(FeltMapTest, TakesTheAdhesionOfAnElasticFitFromThePull) {
  const auto map = load([](std::size_t, std::size_t) {
    PixelFit fit = trusted(1e6, 0.0);
    fit.adhesion_j_per_m2 = std::nan("");
    return fit;
  });
  FitOptions paraboloid = jkr();
  paraboloid.shape = fits::Shape::Paraboloid;
  const auto felt = felt_map(*map, paraboloid);
  ASSERT_TRUE(felt) << felt.error().message;
  EXPECT_EQ(felt->law, physics::Law::Dmt);
  EXPECT_NEAR(static_cast<double>(felt->laws.adhesion_j_per_m2[0]), 5e-9 / (2.0 * std::numbers::pi * kRadiusM), 1e-8);
}

TEST_F(FeltMapTest, IsHertzWhereTheTipHardlySticks) {
  const auto map = load([](std::size_t, std::size_t) {
    PixelFit fit = trusted(1e6, 1e-7);
    return fit;
  });
  const auto felt = felt_map(*map, jkr());
  ASSERT_TRUE(felt) << felt.error().message;
  EXPECT_EQ(felt->law, physics::Law::Hertz);
  EXPECT_THAT(felt_text(*felt), HasSubstr("the tip hardly sticks, law hertz"));
}

TEST_F(FeltMapTest, RefusesAMapWithTooFewFitsAndAShapeWithoutALaw) {
  const auto few = load([](std::size_t column, std::size_t) { return column == 0 ? trusted(1e6, 30e-3) : PixelFit{}; });
  const auto refused = felt_map(*few, jkr());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(refused.error().message, HasSubstr("2 of 6 pixels, and it needs 4"));
  FitOptions cone = jkr();
  cone.shape = fits::Shape::Cone;
  EXPECT_THAT(felt_map(*few, cone).error().message, HasSubstr("fit it with --fit dmt, jkr, paraboloid or sphere"));
}

TEST_F(FeltMapTest, IsASampleWhoseNumbersAreThoseOfItsMap) {
  const auto map = load(
      [](std::size_t column, std::size_t) { return trusted(column == 0 ? 1e6 : 3e6, column == 0 ? 30e-3 : 50e-3); });
  const auto library = scene::load_materials(support::source("assets/materials.toml")).value();
  const auto pixel = make_sample_model(map, {1, 0}, library.materials.front());
  ASSERT_TRUE(pixel) << pixel.error().message;
  const auto whole = make_sample_model(*pixel, jkr());
  ASSERT_TRUE(whole) << whole.error().message;
  EXPECT_EQ(whole->parameters.law, physics::Law::Jkr);
  EXPECT_EQ(whole->parameters.law_map, 1U);
  EXPECT_EQ(whole->parameters.contact.tip_radius.si, kRadiusM);
  EXPECT_TRUE(LiveParameters(*whole).rows().empty());
  EXPECT_TRUE(scene::validate(whole->parameters, 0, 0));
  // 3 um x 2 um about the middle
  EXPECT_EQ(pixel_below(*whole, {0.0, -0.2e-6}), (MapPlace{1, 0}));
  EXPECT_EQ(pixel_below(*whole, {1.4e-6, 0.9e-6}), (MapPlace{2, 1}));
  EXPECT_EQ(pixel_below(*whole, {1.6e-6, 0.0}), std::nullopt);
  EXPECT_EQ(pixel_below(*whole, {std::nan(""), 0.0}), std::nullopt);

  const auto wide = load([](std::size_t column, std::size_t) { return trusted(column == 0 ? 1e4 : 1e9, 30e-3); });
  const auto refused = make_sample_model(make_sample_model(wide, {1, 0}, library.materials.front()).value(), jkr());
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("a hand can feel a factor of 50"));
}

}  // namespace felt_map_test
}  // namespace afm::curves
