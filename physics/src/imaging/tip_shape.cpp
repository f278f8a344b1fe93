// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/tip_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace afm::physics {
namespace {

double ball_m(double radius_m, double beside_m) {
  if (beside_m > radius_m) return std::numeric_limits<double>::infinity();
  return beside_m * beside_m / (radius_m + std::sqrt(radius_m * radius_m - beside_m * beside_m));
}

// A face tangent to the ball from below, at the distance `beside` from the axis along its normal.
double face_m(const TipShape& tip, double beside_m) {
  return beside_m / std::tan(tip.half_angle_rad) - tip.radius.si * (1.0 / std::sin(tip.half_angle_rad) - 1.0);
}

// The ball up to the circle at which the cone is tangent.
double cone_m(const TipShape& tip, double beside_m) {
  const bool on_ball = beside_m <= tip.radius.si * std::cos(tip.half_angle_rad);
  return on_ball ? ball_m(tip.radius.si, beside_m) : face_m(tip, beside_m);
}

// The part of a pyramid filled by balls of the radius: apex and edges are rounded. `x` along the normal of the nearest
// face, `y` across it, `half_sector` the angle between that normal and the next edge.
double pyramid_m(const TipShape& tip, double x_m, double y_m, double half_sector_rad) {
  const double radius_m = tip.radius.si;
  const double on_face_m = x_m - radius_m * std::cos(tip.half_angle_rad);
  if (std::abs(y_m) <= std::tan(half_sector_rad) * on_face_m) return face_m(tip, x_m);

  // the ball that touches here is centred on the line of centres below the edge, or at the apex
  const double slope = std::cos(half_sector_rad) / std::tan(tip.half_angle_rad), steep = std::hypot(1.0, slope);
  const double along_m = x_m * std::cos(half_sector_rad) + std::abs(y_m) * std::sin(half_sector_rad);
  const double across_m = x_m * std::sin(half_sector_rad) - std::abs(y_m) * std::cos(half_sector_rad);
  const double round_m = std::sqrt(std::max(0.0, radius_m * radius_m - across_m * across_m));
  if (along_m >= round_m * slope / steep) return along_m * slope - round_m * steep + radius_m;
  return ball_m(radius_m, std::hypot(x_m, y_m));
}

double pyramid_m(const TipShape& tip, double x_m, double y_m, int faces, double first_normal_rad) {
  const double sector_rad = 2.0 * std::numbers::pi / faces;
  const double from_normal_rad = std::remainder(std::atan2(y_m, x_m) - first_normal_rad, sector_rad);
  const double beside_m = std::hypot(x_m, y_m);
  return pyramid_m(tip, beside_m * std::cos(from_normal_rad), beside_m * std::sin(from_normal_rad), 0.5 * sector_rad);
}

double one_apex_m(const TipShape& tip, double x_m, double y_m) {
  const double beside_m = std::hypot(x_m, y_m);
  switch (tip.kind) {
    case TipKind::Paraboloid:
      return beside_m * beside_m / (2.0 * tip.radius.si);
    case TipKind::Sphere:
      return ball_m(tip.radius.si, beside_m);
    case TipKind::Cone:
      return cone_m(tip, beside_m);
    case TipKind::ThreeSidedPyramid:
      return pyramid_m(tip, x_m, y_m, 3, std::numbers::pi);
    case TipKind::FourSidedPyramid:
      break;
  }
  return pyramid_m(tip, x_m, y_m, 4, 0.0);
}

}  // namespace

std::string_view name_of(TipKind kind) {
  for (const TipKindName& row : kTipKinds) {
    if (row.kind == kind) return row.name;
  }
  throw std::logic_error("no such kind of tip");
}

double TipShape::height_above_apex_m(double x_m, double y_m) const noexcept {
  const double first_m = one_apex_m(*this, x_m, y_m);
  if (second_apex_distance.si <= 0.0) return first_m;
  return std::min(first_m, second_apex_height.si + one_apex_m(*this, x_m - second_apex_distance.si, y_m));
}

TipGrid sample_tip(const TipShape& tip, const HeightGrid& grid, double depth_m) {
  const auto height_m = [&](std::ptrdiff_t column, std::ptrdiff_t row) {
    return tip.height_above_apex_m(static_cast<double>(column) * grid.column_step_m,
                                   static_cast<double>(row) * grid.row_step_m);
  };
  const auto most_columns = static_cast<std::ptrdiff_t>(grid.columns) - 1;
  const auto most_rows = static_cast<std::ptrdiff_t>(grid.rows) - 1;
  // every column of a tip is lowest on the x axis; its rows rise with the distance from it
  std::ptrdiff_t columns = 0, rows = 0;
  for (std::ptrdiff_t i = 1; i <= most_columns; ++i) {
    if (std::min(height_m(i, 0), height_m(-i, 0)) <= depth_m) columns = i;
  }
  const auto row_is_in_depth = [&](std::ptrdiff_t row) {
    for (std::ptrdiff_t i = -most_columns; i <= most_columns; ++i) {
      if (std::min(height_m(i, row), height_m(i, -row)) <= depth_m) return true;
    }
    return false;
  };
  while (rows < most_rows && row_is_in_depth(rows + 1)) ++rows;

  TipGrid sampled{static_cast<std::size_t>(columns), static_cast<std::size_t>(rows), {}};
  sampled.above_apex_m.reserve(sampled.columns() * sampled.rows());
  for (std::ptrdiff_t row = -rows; row <= rows; ++row) {
    for (std::ptrdiff_t column = -columns; column <= columns; ++column) {
      sampled.above_apex_m.push_back(height_m(column, row));
    }
  }
  return sampled;
}

}  // namespace afm::physics
