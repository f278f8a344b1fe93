// SPDX-License-Identifier: Apache-2.0
#include "haptics/sample_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "physics/morphology.h"

namespace afm::haptics {

namespace {

constexpr int kMostSmoothings = 400;

// Heights of one line across the grid, `stride` apart.
struct Line {
  double* first;
  std::size_t stride;
  std::size_t count;

  double& operator[](std::size_t i) const { return first[i * stride]; }
};

// Every row, then every column: what is separable needs no more.
template <class Change>
void change_lines(std::vector<double>& heights_m, std::size_t columns, std::size_t rows, const Change& change) {
  for (std::size_t row = 0; row < rows; ++row) change(Line{&heights_m[row * columns], 1, columns});
  for (std::size_t column = 0; column < columns; ++column) change(Line{&heights_m[column], columns, rows});
}

void smooth(const Line& line) {
  double before = line[0];
  for (std::size_t i = 0; i < line.count; ++i) {
    const double here = line[i];
    line[i] = 0.25 * before + 0.5 * here + 0.25 * line[std::min(i + 1, line.count - 1)];
    before = here;
  }
}

// Of a uniform quadratic B-spline, at `offset` from the middle control point, in spacings, in [-0.5, 0.5].
struct Weights {
  std::array<double, 3> value;
  std::array<double, 3> slope;
};

Weights weights_at(double offset) {
  const double before = 0.5 - offset, after = 0.5 + offset;
  return {{0.5 * before * before, 0.75 - offset * offset, 0.5 * after * after}, {-before, -2.0 * offset, after}};
}

}  // namespace

SampleSurface::SampleSurface(const scene::SharedHeightField& drawn, double tip_radius_m, double largest_curvature_per_m)
    : columns_(static_cast<int>(drawn.columns)), rows_(static_cast<int>(drawn.rows)), spacing_m_(drawn.spacing_m) {
  const std::size_t columns = drawn.columns, rows = drawn.rows;
  controls_m_.assign(drawn.height_m.begin(), drawn.height_m.begin() + static_cast<std::ptrdiff_t>(columns * rows));
  // the origin lies on a grid point, or in the middle between some
  const int left = (columns_ - 1) / 2, right = columns_ / 2, below = (rows_ - 1) / 2, above = rows_ / 2;
  const double drawn_m =
      0.25 * (control_m(left, below) + control_m(right, below) + control_m(left, above) + control_m(right, above));

  physics::HeightGrid traced{.columns = columns,
                             .rows = rows,
                             .column_step_m = spacing_m_,
                             .row_step_m = spacing_m_,
                             .height_m = std::move(controls_m_)};
  physics::dilate_by_paraboloid(traced, physics::Length(tip_radius_m));
  controls_m_ = std::move(traced.height_m);
  for (int i = 0; i < kMostSmoothings; ++i) {
    if (steepest_slope() <= kSteepestSlope && this->largest_curvature_per_m() <= largest_curvature_per_m) break;
    change_lines(controls_m_, columns, rows, smooth);
  }
  const double shift_m = drawn_m - at({0.0, 0.0}).height_m;
  for (double& control_m : controls_m_) control_m += shift_m;
}

double SampleSurface::control_m(int column, int row) const noexcept {
  const int c = std::clamp(column, 0, columns_ - 1), r = std::clamp(row, 0, rows_ - 1);
  return controls_m_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)];
}

SampleSurface::Place SampleSurface::at(const glm::dvec2& xy_m) const noexcept {
  if (columns_ == 0) return {};
  // two spacings beyond the rim it is level; what is no number goes there too
  const auto along = [this](double place_m, int count) {
    return std::max(-2.0, std::min(place_m / spacing_m_ + 0.5 * (count - 1), count + 1.0));
  };
  const double u = along(xy_m.x, columns_), v = along(xy_m.y, rows_);
  const double column = std::floor(u + 0.5), row = std::floor(v + 0.5);
  const Weights wx = weights_at(u - column), wy = weights_at(v - row);
  Place place;
  for (int k = 0; k < 3; ++k) {
    double height_m = 0, slope_m = 0;
    for (int i = 0; i < 3; ++i) {
      const double control = control_m(static_cast<int>(column) + i - 1, static_cast<int>(row) + k - 1);
      height_m += wx.value[static_cast<std::size_t>(i)] * control;
      slope_m += wx.slope[static_cast<std::size_t>(i)] * control;
    }
    place.height_m += wy.value[static_cast<std::size_t>(k)] * height_m;
    place.slope.x += wy.value[static_cast<std::size_t>(k)] * slope_m / spacing_m_;
    place.slope.y += wy.slope[static_cast<std::size_t>(k)] * height_m / spacing_m_;
  }
  return place;
}

// The slopes of a spline are averages of its controls' differences, and their derivatives of second differences.
double SampleSurface::steepest_slope() const noexcept {
  double steepest_x = 0, steepest_y = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      steepest_x = std::max(steepest_x, std::abs(control_m(column + 1, row) - control_m(column, row)));
      steepest_y = std::max(steepest_y, std::abs(control_m(column, row + 1) - control_m(column, row)));
    }
  }
  return std::hypot(steepest_x, steepest_y) / spacing_m_;
}

double SampleSurface::largest_curvature_per_m() const noexcept {
  double along_x = 0, along_y = 0, across = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const double here = control_m(column, row), right = control_m(column + 1, row), up = control_m(column, row + 1);
      along_x = std::max(along_x, std::abs(right - 2.0 * here + control_m(column - 1, row)));
      along_y = std::max(along_y, std::abs(up - 2.0 * here + control_m(column, row - 1)));
      across = std::max(across, std::abs(control_m(column + 1, row + 1) - right - up + here));
    }
  }
  return (std::max(along_x, along_y) + across) / (spacing_m_ * spacing_m_);
}

}  // namespace afm::haptics
