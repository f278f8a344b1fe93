// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "scene/display/wall.h"

// Disparity: the vergence that the depth of a picture requires of a viewer. Angles in radians, room frame in metres.
namespace afm::scene {

// Limit beyond which many viewers cannot fuse pictures without strain (the one-degree rule; Nagata 2002 finds -1.84 to
// 2.04 degrees).
inline constexpr double kComfortableDisparityRad = 0.017453292519943295;

struct Disparity {
  double crossed_rad = 0;  // convergence of the eyes relative to the wall; negative: behind the wall
  double uncrossed_m = 0;  // shift on the wall from the left to the right eye's image; negative: in front of the wall
};

// Disparity of a point straight ahead of a level head that faces the wall squarely; depth_m from the eyes, inf allowed.
Disparity disparity_at(double wall_distance_m, double ipd_m, double depth_m);

// Depths from the eyes within which disparities stay below a limit.
struct ComfortZone {
  double nearest_m = 0;
  double farthest_m = 0;  // farthest comfortable depth; inf: no limit
};
ComfortZone comfort_zone(double wall_distance_m, double ipd_m, double largest_disparity_rad);

}  // namespace afm::scene
