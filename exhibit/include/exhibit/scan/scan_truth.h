// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "physics/imaging/height_grid.h"

namespace afm::exhibit {

// What an image does not show: the sample itself on the image's grid, and where the tip cannot touch it.
struct ReachOfTip {
  physics::HeightGrid sample;           // row 0 is the top one
  std::vector<std::uint8_t> unreached;  // 1: between the sample and the tip is always a gap, as large as is seen
  double unreached_share = 0;           // of the area, 0 to 1
};

// Of a round tip, a paraboloid, over a square around the origin: where the sample lies below its closing by the tip
// (physics/imaging/morphology.h). The rim outside the square is looked at too, so that no border is certain by chance.
// `drawn_m` is the height of the sample, finite everywhere. Some milliseconds.
ReachOfTip reach_of_tip(const std::function<double(double x_m, double y_m)>& drawn_m, double side_m, std::size_t pixels,
                        double tip_radius_m);

// Across the apex, along x: metres beside it and above it.
struct TipProfile {
  std::vector<glm::dvec2> points_m;
};

// The tip that an image alone reveals (physics::tip_of_image), at every second pixel; `noise_m`: of its heights, rms.
// Some milliseconds.
TipProfile tip_revealed_by(const physics::HeightGrid& image, double noise_m);

// The tip that it really is, as far to each side.
TipProfile round_tip(double radius_m, double reach_m);

}  // namespace afm::exhibit
