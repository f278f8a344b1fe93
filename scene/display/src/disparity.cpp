// SPDX-License-Identifier: Apache-2.0
#include "scene/display/disparity.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace afm::scene {

namespace {

// Angle between the lines of sight to a point; well-conditioned for small angles, unlike acos.
double vergence(const glm::dvec3& left_eye, const glm::dvec3& right_eye, const glm::dvec3& point) {
  const glm::dvec3 left = left_eye - point, right = right_eye - point;
  return std::atan2(glm::length(glm::cross(left, right)), glm::dot(left, right));
}

double vergence_at(double depth_m, double ipd_m) { return 2.0 * std::atan(0.5 * ipd_m / depth_m); }

}  // namespace

Disparity disparity_of(const Screen& screen, const glm::dvec3& left_eye_m, const glm::dvec3& right_eye_m,
                       const glm::dvec3& point_m) {
  const glm::dvec3 normal = screen.normal();
  const auto on_wall = [&](const glm::dvec3& eye) {
    const glm::dvec3 direction = point_m - eye;
    return eye + direction * (glm::dot(screen.lower_left - eye, normal) / glm::dot(direction, normal));
  };
  const glm::dvec3 left = on_wall(left_eye_m), right = on_wall(right_eye_m);
  const glm::dvec3 along = glm::normalize(screen.lower_right - screen.lower_left);
  return {.crossed_rad =
              vergence(left_eye_m, right_eye_m, point_m) - vergence(left_eye_m, right_eye_m, 0.5 * (left + right)),
          .uncrossed_m = glm::dot(right - left, along)};
}

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
