// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "physics/imaging/height_grid.h"

namespace afm::exhibit {

// The sample on the image's grid, and the places that the tip cannot touch.
struct ReachOfTip {
  physics::HeightGrid sample;           // row 0 is the top
  std::vector<std::uint8_t> unreached;  // 1: gap between sample and tip that is always visible
  double unreached_share = 0;           // fraction of the area, 0 to 1
};

// Computes the reach of a paraboloidal tip over a square around the origin: unreached is where the sample is below its
// closing by the tip (physics/imaging/morphology.h). Includes a rim outside the square, so that the result at the
// border is reliable. `drawn_m` is the height of the sample, finite everywhere. Takes some milliseconds.
ReachOfTip reach_of_tip(const std::function<double(double x_m, double y_m)>& drawn_m, double side_m, std::size_t pixels,
                        double tip_radius_m);

// Cross-section through the apex, along x: lateral distance and height, metres.
struct TipProfile {
  std::vector<glm::dvec2> points_m;
};

// The tip estimated from an image only (physics::tip_of_image), at every second pixel. `noise_m`: rms of the heights'
// noise. Takes some milliseconds.
TipProfile tip_revealed_by(const physics::HeightGrid& image, double noise_m);

// The actual tip, to a lateral distance of `reach_m` on both sides.
TipProfile round_tip(double radius_m, double reach_m);

}  // namespace afm::exhibit
