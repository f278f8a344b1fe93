// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "physics/imaging/height_grid.h"

namespace afm::physics {

// Surroundings of a sample: from its edge on, the heights of the edge merge into one level plane, the mean of the
// edge, without a jump of height, slope or curvature. Centred on the origin; finite everywhere, also for NaN.
class Rim {
 public:
  // Slope of the transition at most this share of the given one (see width_m below): together with the slope along the
  // edge, which fades, it is nowhere steeper than the sample.
  static constexpr double kSlopeShare = 0.14;

  // A sample without an end: no rim.
  Rim() = default;

  // `edge_m`: heights of the edge. The transition begins at `half_x_m` and `half_y_m`; it is wide enough for `slope`,
  // which is positive, and at least `narrowest_m` wide.
  Rim(std::span<const double> edge_m, double half_x_m, double half_y_m, double slope, double narrowest_m);

  // Share of the edge's height above the level plane, and its derivatives; 1 inside.
  struct Share {
    double value = 1.0;
    double slope_x = 0.0, slope_y = 0.0;  // gradient of the share, 1/m
  };
  Share share_at(double x_m, double y_m) const noexcept {
    const Fade x = fade(x_m, half_x_m_), y = fade(y_m, half_y_m_);
    return {x.value * y.value, x.slope * y.value, x.value * y.slope};
  }

  double level_m() const noexcept { return level_m_; }
  double width_m() const noexcept { return width_m_; }
  double highest_m() const noexcept { return highest_m_; }  // largest distance of the edge from the level

  // Upper limits of the transition's first and second derivative across the edge, per height of the edge.
  double steepest_per_m() const noexcept { return 1.875 / width_m_; }
  double largest_curvature_per_m2() const noexcept { return 5.7736 / (width_m_ * width_m_); }

 private:
  struct Fade {
    double value = 1.0, slope = 0.0;
  };
  // Quintic: 1 - 10 t^3 + 15 t^4 - 6 t^5.
  Fade fade(double place_m, double half_m) const noexcept {
    const double t = (std::abs(place_m) - half_m) / width_m_;
    if (t <= 0.0) return {};
    if (!(t < 1.0)) return {0.0, 0.0};
    const double rest = 1.0 - t;
    const double slope = -30.0 * t * t * rest * rest / width_m_;
    return {rest * rest * rest * (1.0 + t * (3.0 + 6.0 * t)), place_m < 0.0 ? -slope : slope};
  }

  double half_x_m_ = HUGE_VAL, half_y_m_ = HUGE_VAL;
  double level_m_ = 0.0, width_m_ = 1.0, highest_m_ = 0.0;
};

// The values at the edge of a grid, row by row, each once.
std::vector<double> edge_of(std::span<const double> values, std::size_t columns, std::size_t rows);

// The heights of a grid centred on the origin, level beyond its rim. Shared: a measured grid has millions of points.
std::function<double(double x_m, double y_m)> level_beyond_rim(std::shared_ptr<const HeightGrid> grid);

}  // namespace afm::physics
