// SPDX-License-Identifier: Apache-2.0
#include "haptics/sample_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

#include "physics/imaging/morphology.h"
#include "physics/imaging/rim.h"

namespace afm::haptics {

namespace {

constexpr int kMostSmoothings = 400;

// Heights along one line of the grid, `stride` apart.
struct Line {
  double* first;
  std::size_t stride;
  std::size_t count;

  double& operator[](std::size_t i) const { return first[i * stride]; }
};

// Applies a separable operation: to every row, then to every column.
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

// Heights beyond the edge for a mean: the height of the edge, or the mirror image, in which the mean is level there.
enum class Beyond { Edge, Mirror };

std::size_t row_within(std::ptrdiff_t row, std::size_t rows, Beyond beyond) {
  const auto count = static_cast<std::ptrdiff_t>(rows);
  if (beyond == Beyond::Edge) return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(row, 0, count - 1));
  const std::ptrdiff_t turn = ((row % (2 * count)) + 2 * count) % (2 * count);
  return static_cast<std::size_t>(std::min(turn, 2 * count - 1 - turn));
}

// Mean over `half_width` rows on either side.
void box_over_rows(std::span<const double> from, std::size_t columns, std::size_t rows, std::size_t half_width,
                   Beyond beyond, std::vector<double>& sums, std::span<double> to) {
  const auto row_at = [&](std::ptrdiff_t row) {
    return from.subspan(row_within(row, rows, beyond) * columns, columns);
  };
  const auto half = static_cast<std::ptrdiff_t>(half_width);
  const double share = 1.0 / static_cast<double>(2 * half_width + 1);
  sums.assign(columns, 0.0);
  for (std::ptrdiff_t row = -half; row <= half; ++row) {
    const std::span<const double> line = row_at(row);
    for (std::size_t i = 0; i < columns; ++i) sums[i] += line[i];
  }
  for (std::size_t row = 0; row < rows; ++row) {
    const auto here = static_cast<std::ptrdiff_t>(row);
    const std::span<const double> entering = row_at(here + half + 1), leaving = row_at(here - half);
    const std::span<double> target = to.subspan(row * columns, columns);
    for (std::size_t i = 0; i < columns; ++i) {
      target[i] = share * sums[i];
      sums[i] += entering[i] - leaving[i];
    }
  }
}

// Transposes in squares that fit into the cache.
void transpose(std::span<const double> from, std::size_t columns, std::size_t rows, std::span<double> to) {
  constexpr std::size_t kSquare = 32;
  for (std::size_t top = 0; top < rows; top += kSquare) {
    for (std::size_t left = 0; left < columns; left += kSquare) {
      for (std::size_t row = top; row < std::min(top + kSquare, rows); ++row) {
        for (std::size_t column = left; column < std::min(left + kSquare, columns); ++column) {
          to[column * rows + row] = from[row * columns + column];
        }
      }
    }
  }
}

// Three box averages along both axes: nearly a bell curve, at the same cost for every width.
void smooth_by_boxes(std::vector<double>& heights_m, std::size_t columns, std::size_t rows, std::size_t half_width,
                     Beyond beyond) {
  std::vector<double> other(heights_m.size()), sums;
  for (int axis = 0; axis < 2; ++axis) {
    box_over_rows(heights_m, columns, rows, half_width, beyond, sums, other);
    box_over_rows(other, columns, rows, half_width, beyond, sums, heights_m);
    box_over_rows(heights_m, columns, rows, half_width, beyond, sums, other);
    transpose(other, columns, rows, heights_m);
    std::swap(columns, rows);
  }
}

// Weights of a uniform quadratic B-spline at `offset` from the middle control point, in spacings, in [-0.5, 0.5].
struct Weights {
  std::array<double, 3> value;
  std::array<double, 3> slope;
};

Weights weights_at(double offset) {
  const double before = 0.5 - offset, after = 0.5 + offset;
  return {{0.5 * before * before, 0.75 - offset * offset, 0.5 * after * after}, {-before, -2.0 * offset, after}};
}

}  // namespace

SampleSurface::SampleSurface(const scene::FeltHeights& drawn, double tip_radius_m, double largest_curvature_per_m)
    : columns_(static_cast<int>(drawn.columns)),
      rows_(static_cast<int>(drawn.rows)),
      spacing_m_(drawn.columns > 0 ? drawn.spacing_m : 1.0) {
  if (columns_ == 0) return;
  controls_m_.assign(drawn.height_m.begin(), drawn.height_m.end());
  for (double& control_m : controls_m_) control_m *= drawn.height_factor;
  // the origin is on a grid point, or midway between points
  const int left = (columns_ - 1) / 2, right = columns_ / 2, below = (rows_ - 1) / 2, above = rows_ / 2;
  const double drawn_m =
      0.25 * (control_m(left, below) + control_m(right, below) + control_m(left, above) + control_m(right, above));

  if (drawn.heights == scene::Heights::Drawn) {
    trace(tip_radius_m, largest_curvature_per_m);
  } else {
    smooth_widely(largest_curvature_per_m, drawn.heights == scene::Heights::Scaled);
  }
  const double shift_m = drawn.heights == scene::Heights::Scaled ? 0.0 : drawn_m - at({0.0, 0.0}).height_m;
  for (double& control_m : controls_m_) control_m += shift_m;
  add_rim(largest_curvature_per_m);
}

// Wide enough that neither slope nor curvature exceeds the sample's limits where the slope along the edge fades.
void SampleSurface::add_rim(double largest_curvature_per_m) {
  constexpr double kWidthOfBends = 10.0;  // width of the rim in radii of the smallest bend at the steepest slope
  const double slope = steepest_slope();
  if (slope <= 0.0) return;
  const std::vector<double> edge_m =
      physics::edge_of(controls_m_, static_cast<std::size_t>(columns_), static_cast<std::size_t>(rows_));
  // the spline is level across the edge from here on
  const auto half_m = [this](int count) { return (0.5 * (count - 1) + 1.5) * spacing_m_; };
  rim_ = std::make_shared<const physics::Rim>(edge_m, half_m(columns_), half_m(rows_), slope,
                                              std::max(spacing_m_, kWidthOfBends * slope / largest_curvature_per_m));
}

bool SampleSurface::is_gentle(double largest_curvature_per_m) const {
  return steepest_slope() <= kSteepestSlope && this->largest_curvature_per_m() <= largest_curvature_per_m;
}

void SampleSurface::trace(double tip_radius_m, double largest_curvature_per_m) {
  const auto columns = static_cast<std::size_t>(columns_), rows = static_cast<std::size_t>(rows_);
  physics::HeightGrid traced{.columns = columns,
                             .rows = rows,
                             .column_step_m = spacing_m_,
                             .row_step_m = spacing_m_,
                             .height_m = std::move(controls_m_)};
  physics::dilate_by_paraboloid(traced, physics::Length(tip_radius_m));
  controls_m_ = std::move(traced.height_m);
  for (int i = 0; i < kMostSmoothings && !is_gentle(largest_curvature_per_m); ++i) {
    change_lines(controls_m_, columns, rows, smooth);
  }
}

// Finds the narrowest sufficient bell curve: doubles the half width, then bisects.
void SampleSurface::smooth_widely(double largest_curvature_per_m, bool mirrored) {
  const Beyond beyond = mirrored ? Beyond::Mirror : Beyond::Edge;
  if (is_gentle(largest_curvature_per_m)) return;
  const auto columns = static_cast<std::size_t>(columns_), rows = static_cast<std::size_t>(rows_);
  const std::vector<double> heights_m = controls_m_;
  const auto is_gentle_with = [&](std::size_t half_width) {
    controls_m_ = heights_m;
    smooth_by_boxes(controls_m_, columns, rows, half_width, beyond);
    return is_gentle(largest_curvature_per_m);
  };
  // three boxes wider than the grid leave a plane
  const std::size_t widest = 2 * std::max(columns, rows);
  std::size_t enough = 1;
  while (enough < widest && !is_gentle_with(enough)) enough *= 2;
  std::size_t too_narrow = enough / 2;
  while (enough - too_narrow > 1 + too_narrow / 8) {
    const std::size_t middle = too_narrow + (enough - too_narrow) / 2;
    (is_gentle_with(middle) ? enough : too_narrow) = middle;
  }
  if (!is_gentle_with(enough)) std::fill(controls_m_.begin(), controls_m_.end(), controls_m_.front());
}

SampleSurface::Change SampleSurface::change_of(const scene::FeltHeights& drawn) const {
  Change change;
  if (columns_ == 0) return change;
  std::vector<double> by_m;
  by_m.reserve(drawn.height_m.size());
  for (std::uint32_t row = 0; row < drawn.rows; ++row) {
    for (std::uint32_t column = 0; column < drawn.columns; ++column) {
      const glm::dvec2 place_m((column - 0.5 * (drawn.columns - 1)) * drawn.spacing_m,
                               (row - 0.5 * (drawn.rows - 1)) * drawn.spacing_m);
      const double drawn_m =
          drawn.height_factor * static_cast<double>(drawn.height_m[std::size_t{row} * drawn.columns + column]);
      by_m.push_back(at(place_m).height_m - drawn_m);
    }
  }
  const auto count = static_cast<double>(by_m.size());
  const double shift_m = std::accumulate(by_m.begin(), by_m.end(), 0.0) / count;
  for (const double by : by_m) {
    change.largest_m = std::max(change.largest_m, std::abs(by - shift_m));
    change.rms_m += (by - shift_m) * (by - shift_m) / count;
  }
  change.rms_m = std::sqrt(change.rms_m);
  return change;
}

const double* SampleSurface::line_of(int row) const noexcept {
  return controls_m_.data() + static_cast<std::ptrdiff_t>(std::clamp(row, 0, rows_ - 1)) * columns_;
}

double SampleSurface::control_m(int column, int row) const noexcept {
  const int c = std::clamp(column, 0, columns_ - 1), r = std::clamp(row, 0, rows_ - 1);
  return controls_m_[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(c)];
}

SampleSurface::Place SampleSurface::at(const glm::dvec2& xy_m) const noexcept {
  if (columns_ == 0) return {};
  // level from two spacings beyond the edge; NaN goes there too
  const auto along = [this](double place_m, int count) {
    return std::max(-2.0, std::min(place_m / spacing_m_ + 0.5 * (count - 1), count + 1.0));
  };
  const double u = along(xy_m.x, columns_), v = along(xy_m.y, rows_);
  const double column = std::floor(u + 0.5), row = std::floor(v + 0.5);
  const Weights wx = weights_at(u - column), wy = weights_at(v - row);
  const auto within = [](double first, int i, int count) {
    return std::clamp(static_cast<int>(first) + i - 1, 0, count - 1);
  };
  const std::array<int, 3> columns{within(column, 0, columns_), within(column, 1, columns_),
                                   within(column, 2, columns_)};
  Place place;
  for (std::size_t k = 0; k < 3; ++k) {
    const double* const line = line_of(static_cast<int>(row) + static_cast<int>(k) - 1);
    double height_m = 0, slope_m = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const double control = line[columns[i]];
      height_m += wx.value[i] * control;
      slope_m += wx.slope[i] * control;
    }
    place.height_m += wy.value[k] * height_m;
    place.slope.x += wy.value[k] * slope_m / spacing_m_;
    place.slope.y += wy.slope[k] * height_m / spacing_m_;
  }
  if (!rim_) return place;
  if (const physics::Rim::Share share = rim_->share_at(xy_m.x, xy_m.y); share.value != 1.0) {
    const double above_m = place.height_m - rim_->level_m();
    place.height_m = rim_->level_m() + share.value * above_m;
    place.slope = share.value * place.slope + above_m * glm::dvec2(share.slope_x, share.slope_y);
  }
  return place;
}

// Uses that the slopes of a spline are averages of its controls' differences, and their derivatives of second
// differences.
bool SampleSurface::covers(const glm::dvec2& xy_m) const noexcept {
  return columns_ == 0 ||
         (std::abs(xy_m.x) <= 0.5 * spacing_m_ * (columns_ - 1) && std::abs(xy_m.y) <= 0.5 * spacing_m_ * (rows_ - 1));
}

double SampleSurface::steepest_slope() const noexcept {
  double steepest_x = 0, steepest_y = 0;
  for (int row = 0; row < rows_; ++row) {
    const double *here = line_of(row), *above = line_of(row + 1);
    for (int column = 0; column < columns_; ++column) {
      const int right = std::min(column + 1, columns_ - 1);
      steepest_x = std::max(steepest_x, std::abs(here[right] - here[column]));
      steepest_y = std::max(steepest_y, std::abs(above[column] - here[column]));
    }
  }
  return std::hypot(steepest_x, steepest_y) / spacing_m_;
}

double SampleSurface::largest_curvature_per_m() const noexcept {
  double along_x = 0, along_y = 0, across = 0;
  for (int row = 0; row < rows_; ++row) {
    const double *line = line_of(row), *above = line_of(row + 1), *below = line_of(row - 1);
    for (int column = 0; column < columns_; ++column) {
      const int after = std::min(column + 1, columns_ - 1), before = std::max(column - 1, 0);
      const double here = line[column], right = line[after], up = above[column];
      along_x = std::max(along_x, std::abs(right - 2.0 * here + line[before]));
      along_y = std::max(along_y, std::abs(up - 2.0 * here + below[column]));
      across = std::max(across, std::abs(above[after] - right - up + here));
    }
  }
  const double inside = (std::max(along_x, along_y) + across) / (spacing_m_ * spacing_m_);
  if (!rim_) return inside;
  const double of_rim =
      rim_->highest_m() * rim_->largest_curvature_per_m2() + steepest_slope() * rim_->steepest_per_m();
  return std::max(inside, of_rim);
}

}  // namespace afm::haptics
