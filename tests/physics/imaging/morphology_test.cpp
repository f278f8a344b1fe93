// SPDX-License-Identifier: Apache-2.0
// Invariant: dilation and erosion are adjoint; certain places are the sample; a blind tip is nowhere sharper than the
// true one
#include "physics/imaging/morphology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

// A02 to A14, A36 and F15 are rows of the table of cases.
namespace morphology_test {

using namespace afm::physics;

HeightGrid grid(std::size_t columns, std::size_t rows, std::vector<double> heights) {
  HeightGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.height_m = std::move(heights);
  return grid;
}

HeightGrid line(std::vector<double> heights) {
  const std::size_t count = heights.size();
  return grid(count, 1, std::move(heights));
}

// Tip given by depths below the apex as negative numbers: T(u) is minus the height above it.
TipGrid tip(std::size_t reach_columns, std::size_t reach_rows, std::vector<double> below_apex) {
  for (double& value : below_apex) value = 0.0 - value;
  return {reach_columns, reach_rows, std::move(below_apex)};
}

std::vector<double> spike(std::size_t count, double height) {
  std::vector<double> heights(count, 0.0);
  heights[count / 2] = height;
  return heights;
}

// Villarrubia's P(d) = -T(-d).
std::vector<double> reflected(const TipGrid& tip) {
  std::vector<double> p(tip.above_apex_m.rbegin(), tip.above_apex_m.rend());
  for (double& value : p) value = 0.0 - value;
  return p;
}

const TipGrid kAsymmetric = tip(2, 0, {-6, -2, 0, -1, -3});
const TipGrid kSymmetric = tip(2, 0, {-4, -1, 0, -1, -4});
const std::vector<double> kBlockAndSpike{0, 0, 0, 0, 6, 6, 6, 6, 0, 0, 0, 2, 0, 0, 0, 0};

TEST(Morphology, A02ImagesASpikeAsTheReflectedTip) {
  EXPECT_EQ(dilate(line(spike(11, 5)), kAsymmetric).height_m, (std::vector<double>{0, 0, 0, 2, 4, 5, 3, 0, 0, 0, 0}));
}

TEST(Morphology, A05ReconstructsWhatTheTipReached) {
  const HeightGrid image = dilate(line(kBlockAndSpike), kSymmetric);
  const HeightGrid reconstruction = erode(image, kSymmetric);
  EXPECT_EQ(reconstruction.height_m, (std::vector<double>{0, 0, 1, 3, 6, 6, 6, 6, 3, 2, 1, 2, 1, 0, 0, 0}));
  EXPECT_EQ(dilate(reconstruction, kSymmetric).height_m, image.height_m);
}

TEST(Morphology, A06MarksWhatASingleTouchMakesCertain) {
  const HeightGrid image = dilate(line(kBlockAndSpike), kSymmetric);
  const std::vector<std::uint8_t> expected{0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 0};
  EXPECT_EQ(certainty_map(image, erode(image, kSymmetric), kSymmetric, 0.0), expected);
}

TEST(Morphology, A07FindsTheTipThatASpikeReveals) {
  const TipGrid sharp = tip(2, 0, {-7, -3, 0, -2, -8});
  const TipGrid found = tip_of_image(dilate(line(spike(21, 9)), sharp), 2, 0, 0.0);
  EXPECT_EQ(reflected(found), (std::vector<double>{-8, -2, 0, -3, -7}));
  EXPECT_EQ(found.above_apex_m, sharp.above_apex_m);
}

TEST(Morphology, A08FindsOnlyABoundBelowTheFootOfASpike) {
  const TipGrid sharp = tip(2, 0, {-7, -3, 0, -2, -8});
  const TipGrid found = tip_of_image(dilate(line(spike(21, 5)), sharp), 2, 0, 0.0);
  EXPECT_EQ(reflected(found), (std::vector<double>{-5, -2, 0, -3, -5}));
}

TEST(Morphology, A09ImagesASpikeInTwoDimensions) {
  HeightGrid surface = grid(7, 7, std::vector<double>(49, 0.0));
  surface.at(3, 3) = 4;
  const HeightGrid image = dilate(surface, tip(1, 1, {-9, -2, -9, -3, 0, -1, -9, -5, -9}));
  std::vector<double> middle;
  for (std::size_t row = 2; row <= 4; ++row) {
    for (std::size_t column = 2; column <= 4; ++column) middle.push_back(image.at(column, row));
  }
  EXPECT_EQ(middle, (std::vector<double>{0, 0, 0, 3, 4, 1, 0, 2, 0}));
}

// The height of a tip's apex at x over a profile that is given between two places, by a search of where it touches.
double apex_height_m(const TipShape& shape, double x_m, double from_m, double to_m,
                     const std::function<double(double)>& profile) {
  const auto touching = [&](double at_m) { return profile(at_m) - shape.height_above_apex_m(at_m - x_m, 0.0); };
  constexpr int kPlaces = 400;
  double best_m = from_m;
  for (int i = 0; i <= kPlaces; ++i) {
    const double at_m = from_m + (to_m - from_m) * i / kPlaces;
    if (touching(at_m) > touching(best_m)) best_m = at_m;
  }
  double low_m = std::max(from_m, best_m - (to_m - from_m) / kPlaces);
  double high_m = std::min(to_m, best_m + (to_m - from_m) / kPlaces);
  for (int i = 0; i < 200; ++i) {
    const double a = low_m + (high_m - low_m) / 3.0, b = high_m - (high_m - low_m) / 3.0;
    (touching(a) < touching(b) ? low_m : high_m) = touching(a) < touching(b) ? a : b;
  }
  return touching(0.5 * (low_m + high_m));
}

// A particle of radius 10 nm on a plane: half the width of its image at a height.
double half_width_m(const TipShape& shape, double height_m) {
  constexpr double kParticle = 10e-9;
  const auto profile = [](double x) { return kParticle + std::sqrt(std::max(0.0, kParticle * kParticle - x * x)); };
  double inside_m = 0.0, outside_m = 100e-9;
  for (int i = 0; i < 200; ++i) {
    const double x_m = 0.5 * (inside_m + outside_m);
    (apex_height_m(shape, x_m, -kParticle, kParticle, profile) > height_m ? inside_m : outside_m) = x_m;
  }
  return inside_m;
}

TEST(Morphology, A10MakesAParticleAsWideAsTwoSpheresSideBySide) {
  const TipShape ball{.kind = TipKind::Sphere, .radius = Length(20e-9)};
  EXPECT_NEAR(2.0 * half_width_m(ball, 0.0) / 5.656854249e-08, 1.0, 1e-9);
}

TEST(Morphology, A11MakesAParticleWideAtHalfItsHeight) {
  const TipShape ball{.kind = TipKind::Sphere, .radius = Length(20e-9)};
  EXPECT_NEAR(2.0 * half_width_m(ball, 10e-9) / 4.472135955e-08, 1.0, 1e-9);
}

TEST(Morphology, A12MakesAParticleWiderByAParaboloid) {
  const TipShape paraboloid{.kind = TipKind::Paraboloid, .radius = Length(20e-9)};
  EXPECT_NEAR(2.0 * half_width_m(paraboloid, 10e-9) / 4.787079084e-08, 1.0, 1e-6);
}

TEST(Morphology, A14LeavesATrenchShallow) {
  HeightGrid trench = line(std::vector<double>(401, 0.0));
  trench.column_step_m = 0.25e-9;
  for (std::size_t i = 161; i < 240; ++i) trench.height_m[i] = -30e-9;  // trench between rims that are 20 nm apart
  const HeightGrid image = image_of(trench, {.kind = TipKind::Paraboloid, .radius = Length(20e-9)});
  EXPECT_NEAR(*std::min_element(image.height_m.begin(), image.height_m.end()) / -2.5e-9, 1.0, 1e-9);
}

TEST(Morphology, F15ShowsAGhostBesideASpike) {
  HeightGrid surface = line(spike(401, 10e-9));
  surface.column_step_m = 1e-9;
  const TipShape twofold{.kind = TipKind::Paraboloid,
                         .radius = Length(5e-9),
                         .second_apex_distance = Length(60e-9),
                         .second_apex_height = Length(3e-9)};
  const HeightGrid image = image_of(surface, twofold);
  EXPECT_NEAR(image.height_m[200], 10e-9, 1e-18);
  EXPECT_NEAR(image.height_m[140] / 7e-9, 1.0, 1e-9) << "the second apex, to the right, is over the spike";
  EXPECT_EQ(image.height_m[260], 0.0);
}

class RandomSurfaces : public testing::Test {
 protected:
  HeightGrid surface(std::size_t columns, std::size_t rows, int highest) {
    std::vector<double> heights(columns * rows);
    for (double& height : heights) height = whole(0, highest);
    return grid(columns, rows, std::move(heights));
  }
  TipGrid any_tip() {
    TipGrid tip{number(0, 3), number(0, 3), {}};
    tip.above_apex_m.resize(tip.columns() * tip.rows());
    for (double& above : tip.above_apex_m) above = whole(0, 9);
    tip.above_apex_m[tip.above_apex_m.size() / 2] = 0.0;
    return tip;
  }
  double whole(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
  std::size_t number(int least, int most) { return static_cast<std::size_t>(whole(least, most)); }

  std::mt19937 random_{19};
};

bool nowhere_above(const HeightGrid& low, const HeightGrid& high) {
  return std::equal(low.height_m.begin(), low.height_m.end(), high.height_m.begin(), std::less_equal<>());
}

TEST_F(RandomSurfaces, AreReconstructedFromAboveAndOnce) {
  for (int i = 0; i < 1000; ++i) {
    const HeightGrid surface = this->surface(number(1, 20), number(1, 20), 12);
    const TipGrid tip = any_tip();
    const HeightGrid image = dilate(surface, tip), reconstruction = erode(image, tip);
    ASSERT_TRUE(nowhere_above(surface, reconstruction));
    ASSERT_EQ(dilate(reconstruction, tip).height_m, image.height_m);
    ASSERT_EQ(erode(dilate(reconstruction, tip), tip).height_m, reconstruction.height_m);
  }
}

TEST_F(RandomSurfaces, AreDilatedBelowAnImageWhereTheyAreBelowItsErosion) {
  int below = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::size_t columns = number(1, 12), rows = number(1, 12);
    const HeightGrid surface = this->surface(columns, rows, 6);
    HeightGrid image = this->surface(columns, rows, 6);
    const TipGrid tip = any_tip();
    if (i % 2 == 0) {
      // mostly above the surface's image, so that both answers occur
      const HeightGrid own = dilate(surface, tip);
      for (std::size_t k = 0; k < own.height_m.size(); ++k) image.height_m[k] = own.height_m[k] + (k % 7 == 3 ? 0 : 1);
      image.height_m[number(0, static_cast<int>(columns * rows) - 1)] -= whole(0, 2);
    }
    const bool image_is_above = nowhere_above(dilate(surface, tip), image);
    ASSERT_EQ(image_is_above, nowhere_above(surface, erode(image, tip)));
    below += image_is_above ? 1 : 0;
  }
  EXPECT_GT(below, 100);
  EXPECT_LT(below, 900);
}

TEST_F(RandomSurfaces, AreCertainOnlyWhereTheReconstructionIsTheSurface) {
  std::size_t certain = 0;
  for (int i = 0; i < 1000; ++i) {
    const HeightGrid surface = this->surface(24, 16, 12);
    const TipGrid tip = any_tip();
    const HeightGrid image = dilate(surface, tip), reconstruction = erode(image, tip);
    const std::vector<std::uint8_t> map = certainty_map(image, reconstruction, tip, 0.0);
    for (std::size_t k = 0; k < map.size(); ++k) {
      if (map[k] == 0) continue;
      ASSERT_EQ(reconstruction.height_m[k], surface.height_m[k]);
      ++certain;
    }
  }
  EXPECT_GT(certain, 10'000U);
}

TEST_F(RandomSurfaces, RevealATipThatIsNowhereSharperThanTheTrueOne) {
  for (int i = 0; i < 100; ++i) {
    const HeightGrid surface = this->surface(28, 24, 12);
    const TipGrid tip = any_tip();
    const TipGrid found = tip_of_image(dilate(surface, tip), tip.reach_columns, tip.reach_rows, 0.0);
    for (std::size_t k = 0; k < found.above_apex_m.size(); ++k) {
      ASSERT_LE(found.above_apex_m[k], tip.above_apex_m[k]);
    }
  }
}

TEST_F(RandomSurfaces, RevealNoSharperTipWithAThresholdForNoise) {
  HeightGrid image = surface(40, 30, 12);
  const TipGrid pointed = tip(1, 1, {-9, -4, -9, -4, 0, -4, -9, -4, -9});
  image = dilate(image, pointed);
  for (double& height : image.height_m) height += 0.4 * (whole(0, 1) - 0.5);
  const TipGrid sure = tip_of_image(image, 1, 1, 0.8), rash = tip_of_image(image, 1, 1, 0.0);
  bool rash_is_too_sharp = false;
  for (std::size_t k = 0; k < sure.above_apex_m.size(); ++k) {
    EXPECT_LE(sure.above_apex_m[k], pointed.above_apex_m[k]);
    rash_is_too_sharp = rash_is_too_sharp || rash.above_apex_m[k] > pointed.above_apex_m[k];
  }
  EXPECT_TRUE(rash_is_too_sharp);
}

// The definition, place by place.
double hung_over_all_m(const HeightGrid& surface, double radius_m, std::size_t column, std::size_t row) {
  double highest_m = surface.at(column, row);
  for (std::size_t r = 0; r < surface.rows; ++r) {
    for (std::size_t c = 0; c < surface.columns; ++c) {
      const double x = (static_cast<double>(c) - static_cast<double>(column)) * surface.column_step_m;
      const double y = (static_cast<double>(r) - static_cast<double>(row)) * surface.row_step_m;
      highest_m = std::max(highest_m, surface.at(c, r) - (x * x + y * y) / (2.0 * radius_m));
    }
  }
  return highest_m;
}

TEST_F(RandomSurfaces, A36AreDilatedByAParaboloidInTwoPasses) {
  HeightGrid surface = grid(48, 48, std::vector<double>(48 * 48));
  std::uniform_real_distribution<double> height(0.0, 5.0);
  for (double& h : surface.height_m) h = height(random_);
  HeightGrid image = surface;
  dilate_by_paraboloid(image, Length(20.0));
  for (std::size_t row = 0; row < 48; ++row) {
    for (std::size_t column = 0; column < 48; ++column) {
      ASSERT_NEAR(image.at(column, row), hung_over_all_m(surface, 20.0, column, row), 1e-12);
    }
  }
  HeightGrid closed = image;
  erode_by_paraboloid(closed, Length(20.0));
  EXPECT_TRUE(nowhere_above(surface, closed));
}

// Heights in steps make ties, at which rounding could choose another parabola.
TEST_F(RandomSurfaces, AreDilatedByAnEnvelopeToTheLastBit) {
  for (int i = 0; i < 1000; ++i) {
    const std::size_t count = number(1, 200);
    HeightGrid surface = this->surface(count, 1, 4 + i % 40);
    surface.column_step_m = 0.1e-9 * whole(1, 20);
    const double radius_m = 1e-9 * whole(1, 60), unit_m = i % 3 == 0 ? 0.1e-9 : surface.column_step_m;
    for (double& height : surface.height_m) height *= unit_m * (i % 5 == 0 ? 0.125 : 1.0);
    HeightGrid image = surface;
    dilate_by_paraboloid(image, Length(radius_m));
    for (std::size_t k = 0; k < count; ++k) {
      double highest_m = surface.height_m[k];
      for (std::size_t n = 0; n < count; ++n) {
        const double distance_m = (static_cast<double>(k) - static_cast<double>(n)) * surface.column_step_m;
        highest_m = std::max(highest_m, surface.height_m[n] - distance_m * distance_m / (2.0 * radius_m));
      }
      ASSERT_EQ(image.height_m[k], highest_m) << i << ' ' << k;
    }
  }
}

TEST(TipShape, BeginsAsRoundAsItsRadius) {
  constexpr double kRadius = 20e-9, kBeside = 0.5e-9;
  for (const TipKindName& kind : kTipKinds) {
    const TipShape shape{.kind = kind.kind, .radius = Length(kRadius), .half_angle_rad = 0.3};
    EXPECT_EQ(shape.height_above_apex_m(0.0, 0.0), 0.0) << kind.name;
    for (const double angle : {0.0, 0.4, 1.0, 2.2, 3.1, 4.5, 5.9}) {
      const double above_m = shape.height_above_apex_m(kBeside * std::cos(angle), kBeside * std::sin(angle));
      EXPECT_NEAR(above_m / (kBeside * kBeside / (2.0 * kRadius)), 1.0, 1e-3) << kind.name << ' ' << angle;
    }
  }
}

TEST(TipShape, NeitherJumpsNorFallsAwayFromItsApex) {
  for (const TipKindName& kind : kTipKinds) {
    const TipShape shape{.kind = kind.kind, .radius = Length(20e-9), .half_angle_rad = 0.4};
    const double reach_m = kind.kind == TipKind::Sphere ? 19e-9 : 200e-9;
    for (int i = 0; i < 360; ++i) {
      double before_m = 0.0;
      for (double beside_m = 0.0; beside_m < reach_m; beside_m += 0.1e-9) {
        const double above_m =
            shape.height_above_apex_m(beside_m * std::cos(0.01745 * i), beside_m * std::sin(0.01745 * i));
        ASSERT_GE(above_m, before_m - 1e-20) << kind.name;
        ASSERT_LE(above_m, before_m + 1.1e-9) << kind.name;
        before_m = above_m;
      }
    }
  }
}

TEST(TipShape, HasTheFacesOfItsKind) {
  constexpr double kFar = 1e-6, kAngle = 0.4;
  const double slope = 1.0 / std::tan(kAngle);
  const auto rise = [&](TipKind kind, double angle) {
    const TipShape shape{.kind = kind, .radius = Length(10e-9), .half_angle_rad = kAngle};
    const double x = std::cos(angle), y = std::sin(angle);
    return (shape.height_above_apex_m(2.0 * kFar * x, 2.0 * kFar * y) - shape.height_above_apex_m(kFar * x, kFar * y)) /
           kFar;
  };
  EXPECT_NEAR(rise(TipKind::Cone, 1.234), slope, 1e-9);
  EXPECT_NEAR(rise(TipKind::FourSidedPyramid, 0.0), slope, 1e-9);
  EXPECT_NEAR(rise(TipKind::FourSidedPyramid, -std::numbers::pi / 2.0), slope, 1e-9);
  EXPECT_NEAR(rise(TipKind::FourSidedPyramid, std::numbers::pi / 4.0), slope * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(rise(TipKind::ThreeSidedPyramid, std::numbers::pi), slope, 1e-9);
  EXPECT_NEAR(rise(TipKind::ThreeSidedPyramid, 0.0), slope * 0.5, 1e-9);
  EXPECT_NEAR(rise(TipKind::ThreeSidedPyramid, 2.0 * std::numbers::pi / 3.0), slope * 0.5, 1e-9);
}

TEST(TipShape, OnAGridHasNoMoreThanCanTouch) {
  HeightGrid surface = grid(101, 81, std::vector<double>(101 * 81, 0.0));
  surface.column_step_m = 1e-9;
  surface.row_step_m = -1e-9;
  const TipShape pyramid{.kind = TipKind::ThreeSidedPyramid, .radius = Length(5e-9), .half_angle_rad = 0.7};
  const TipGrid sampled = sample_tip(pyramid, surface, 12e-9);
  ASSERT_EQ(sampled.above_apex_m.size(), sampled.columns() * sampled.rows());
  const auto above_m = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
    return pyramid.height_above_apex_m(1e-9 * static_cast<double>(column), -1e-9 * static_cast<double>(row));
  };
  const auto reach_x = static_cast<std::ptrdiff_t>(sampled.reach_columns);
  const auto reach_y = static_cast<std::ptrdiff_t>(sampled.reach_rows);
  EXPECT_GT(reach_x, 5);
  for (std::ptrdiff_t row = -80; row <= 80; ++row) {
    for (std::ptrdiff_t column = -100; column <= 100; ++column) {
      const bool sampled_there = std::abs(row) <= reach_y && std::abs(column) <= reach_x;
      ASSERT_TRUE(sampled_there || above_m(column, row) > 12e-9);
    }
  }
  EXPECT_EQ(sampled.above_apex_m.front(), above_m(-reach_x, -reach_y));
  EXPECT_EQ(sampled.above_apex_m[sampled.above_apex_m.size() / 2], 0.0);
}

TEST(HeightGrid, IsLinearBetweenItsPointsAndLevelBeyondThem) {
  HeightGrid surface = grid(2, 3, {0, 1, 2, 3, 4, 5});
  surface.x_first_m = 10.0;
  surface.y_first_m = 4.0;
  surface.column_step_m = 2.0;
  surface.row_step_m = -1.0;
  EXPECT_EQ(surface.height_at_m(10.0, 4.0), 0.0);
  EXPECT_EQ(surface.height_at_m(12.0, 2.0), 5.0);
  EXPECT_NEAR(surface.height_at_m(11.0, 3.5), 1.5, 1e-15);
  EXPECT_EQ(surface.height_at_m(100.0, -100.0), 5.0);
  EXPECT_EQ(surface.height_at_m(-100.0, 100.0), 0.0);
  EXPECT_EQ(surface.height_at_m(std::nan(""), 4.0), 0.0);
  EXPECT_EQ(surface.range_m(), 5.0);
}

}  // namespace morphology_test
