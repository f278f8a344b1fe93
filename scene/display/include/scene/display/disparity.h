// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "scene/display/wall.h"

// Disparity: the vergence that the depth of a picture demands of a viewer. Angles in radians, room frame in metres.
namespace afm::scene {

// Beyond it pictures cease to fuse without strain for many (the one-degree rule; Nagata 2002 finds -1.84 to 2.04
// degrees).
inline constexpr double kComfortableDisparityRad = 0.017453292519943295;

struct Disparity {
  double crossed_rad = 0;  // how much more the eyes turn in than for the wall; negative behind it
  double uncrossed_m = 0;  // on the wall, from the left eye's image of the point to the right eye's; negative before it
};

// Of a point before both eyes. The eyes lie in front of the screen.
Disparity disparity_of(const Screen& screen, const glm::dvec3& left_eye_m, const glm::dvec3& right_eye_m,
                       const glm::dvec3& point_m);

// The same for a point straight ahead of a level head that faces the wall squarely; depth_m from the eyes, inf allowed.
Disparity disparity_at(double wall_distance_m, double ipd_m, double depth_m);

// Between which depths from the eyes disparities stay within a limit.
struct ComfortZone {
  double nearest_m = 0;
  double farthest_m = 0;  // inf: however far
};
ComfortZone comfort_zone(double wall_distance_m, double ipd_m, double largest_disparity_rad);

}  // namespace afm::scene
