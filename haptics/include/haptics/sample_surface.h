// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "scene/shared/felt_heights.h"

namespace afm::physics {
class Rim;
}

namespace afm::haptics {

// Surface that a tip follows, in the sample's frame and in metres of the nanoworld: the path of a round tip's apex
// sliding over the drawn surface. Immutable; at() may be called from any thread.
//
// - It is the drawn surface dilated by the tip (Villarrubia, J. Res. NIST 102, 425 (1997)), taken as a paraboloid of
//   its radius: convex parts become as round as the tip, dents narrower than the tip are not felt, and flat parts are
//   unchanged. Its slope is that of the drawn surface at the point that the tip touches.
// - Between grid points it is their uniform quadratic B-spline: continuous with its slope, never outside the range of
//   the surrounding heights, and computed from nine of them whatever the size of the grid.
// - It is smoothed (binomial, as often as needed) until its slope is below kSteepestSlope and its curvature below the
//   caller's limit: where the tip would touch two slopes at once, the dilated surface has a crease.
// - A topography measured by an instrument is not dilated: its heights are already those of an apex. It is smoothed
//   only as far as those limits require, by a bell curve, however many points it has.
// - It is shifted along z to the height of the drawn surface at the origin, where events are compared. Another quantity
//   of a place (scene::Heights::Scaled) is neither dilated nor shifted, and mirrored at the edge while it is smoothed.
// - Beyond the edge the heights of the edge merge into one level plane (physics::Rim), never steeper than the sample.
class SampleSurface {
 public:
  // The force acts along (-slope, 1); at this slope it is a tenth longer than the force along the sample's normal.
  static constexpr double kSteepestSlope = 0.45;

  struct Place {
    double height_m = 0;
    glm::dvec2 slope{0.0};  // slope of the height along x and y
  };

  // Plane z = 0.
  SampleSurface() = default;

  // `drawn` is valid (scene::validate), the other two are positive. Takes some milliseconds for the largest height
  // field, some tenths of a second for the largest topography, and allocates.
  SampleSurface(const scene::FeltHeights& drawn, double tip_radius_m, double largest_curvature_per_m);

  // Wait-free, may be called in a tick of the servo, for any position.
  Place at(const glm::dvec2& xy_m) const noexcept;

  // True for a position inside the edge; a plane has no edge.
  bool covers(const glm::dvec2& xy_m) const noexcept;

  // Upper limits of the slope's magnitude and of the norm of its derivative, anywhere.
  double steepest_slope() const noexcept;
  double largest_curvature_per_m() const noexcept;

  // Difference from the original heights: the largest change by smoothing, and the root mean square about the mean
  // change, which is a shift.
  struct Change {
    double largest_m = 0;
    double rms_m = 0;
  };
  Change change_of(const scene::FeltHeights& drawn) const;

 private:
  void trace(double tip_radius_m, double largest_curvature_per_m);
  void smooth_widely(double largest_curvature_per_m, bool mirrored);
  void add_rim(double largest_curvature_per_m);
  bool is_gentle(double largest_curvature_per_m) const;
  const double* line_of(int row) const noexcept;         // heights of a row, clamped to the grid
  double control_m(int column, int row) const noexcept;  // height of a control point, clamped to the grid

  int columns_ = 0;
  int rows_ = 0;
  double spacing_m_ = 1;
  std::vector<double> controls_m_;
  std::shared_ptr<const physics::Rim> rim_;  // surroundings of the grid, shared by copies; null: none
};

}  // namespace afm::haptics
