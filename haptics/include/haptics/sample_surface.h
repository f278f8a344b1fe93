// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "scene/shared/felt_heights.h"

namespace afm::haptics {

// The surface that a tip follows, in the sample's frame and in metres of the nanoworld: what the apex of a round tip
// traces when it slides over the drawn surface. Immutable; at() may be called from any thread.
//
// - It is the drawn surface dilated by the tip (Villarrubia, J. Res. NIST 102, 425 (1997)), taken as a paraboloid of
// its
//   radius: convex parts become as round as the tip, dents that are narrower than it are not felt, and a flat part
//   stays as it is drawn. Its slope is that of the drawn surface where the tip touches it.
// - Between the grid's points it is their uniform quadratic B-spline: continuous with its slope, never outside of the
//   heights around it, nine of which are looked at whatever the size of the grid.
// - It is smoothed (binomial, as often as is needed) until its slope stays below kSteepestSlope and its curvature below
//   what the caller asks for: where the tip would touch two slopes at once, the dilated surface has a crease.
// - A topography that an instrument measured is not dilated: its heights are those of an apex already. Smoothed it is
//   just as far as those bounds ask for, by a bell curve, however many points it has.
// - It is shifted along z, so that it has the height of the drawn one at the origin, where events are compared.
// - Beyond the rim it goes on level, as high as the rim is.
class SampleSurface {
 public:
  // The force is taken along (-slope, 1), which is then at most a tenth longer than the force along the sample's
  // normal.
  static constexpr double kSteepestSlope = 0.45;

  struct Place {
    double height_m = 0;
    glm::dvec2 slope{0.0};  // d height/dx, d height/dy
  };

  // The plane z = 0.
  SampleSurface() = default;

  // `drawn` is valid (scene::validate), the other two are above zero. Takes some milliseconds for the largest height
  // field, some tenths of a second for the largest topography, and allocates.
  SampleSurface(const scene::FeltHeights& drawn, double tip_radius_m, double largest_curvature_per_m);

  // Wait-free, for a tick of the servo, wherever the tip is.
  Place at(const glm::dvec2& xy_m) const noexcept;

  // True for a place that is no farther out than the rim; a plane has none.
  bool covers(const glm::dvec2& xy_m) const noexcept;

  // Bounds of the length of the slope and of the norm of its derivative, anywhere.
  double steepest_slope() const noexcept;
  double largest_curvature_per_m() const noexcept;

  // Of the heights that it was made of: the largest change by smoothing, and the root of its mean square, about the
  // mean change, which is a shift.
  struct Change {
    double largest_m = 0;
    double rms_m = 0;
  };
  Change change_of(const scene::FeltHeights& drawn) const;

 private:
  void trace(double tip_radius_m, double largest_curvature_per_m);
  void smooth_widely(double largest_curvature_per_m);
  bool is_gentle(double largest_curvature_per_m) const;
  const double* line_of(int row) const noexcept;         // of the grid, clamped
  double control_m(int column, int row) const noexcept;  // clamped to the grid

  int columns_ = 0;
  int rows_ = 0;
  double spacing_m_ = 1;
  std::vector<double> controls_m_;
};

}  // namespace afm::haptics
