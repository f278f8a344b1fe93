// SPDX-License-Identifier: Apache-2.0
#include "scene/display/disparity.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace afm::scene {

namespace {

double vergence_at(double depth_m, double ipd_m) { return 2.0 * std::atan(0.5 * ipd_m / depth_m); }

}  // namespace

Disparity disparity_at(double wall_distance_m, double ipd_m, double depth_m) {
  return {.crossed_rad = vergence_at(depth_m, ipd_m) - vergence_at(wall_distance_m, ipd_m),
          .uncrossed_m = ipd_m * (1.0 - wall_distance_m / depth_m)};
}

ComfortZone comfort_zone(double wall_distance_m, double ipd_m, double largest_disparity_rad) {
  const auto depth_of = [&](double angle) { return 0.5 * ipd_m / std::tan(0.5 * angle); };
  const double on_wall = vergence_at(wall_distance_m, ipd_m);
  return {.nearest_m = depth_of(on_wall + largest_disparity_rad),
          .farthest_m = on_wall > largest_disparity_rad ? depth_of(on_wall - largest_disparity_rad)
                                                        : std::numeric_limits<double>::infinity()};
}

}  // namespace afm::scene
