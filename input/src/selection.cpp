// SPDX-License-Identifier: Apache-2.0
#include "input/selection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace afm::input {

std::optional<std::size_t> pick(const Ray& ray, double cone_rad, std::span<const Target> targets) {
  std::optional<std::size_t> best;
  double best_gap = std::numeric_limits<double>::infinity();
  double best_distance = best_gap;

  for (std::size_t i = 0; i < targets.size(); ++i) {
    const glm::dvec3 to_center = targets[i].center_m - ray.origin_m;
    const double distance = glm::length(to_center);
    if (!(distance > targets[i].radius_m)) continue;  // inside the target, or not a number

    // atan2 of cross and dot stays exact at small angles, where acos of the dot product does not
    const double angle =
        std::atan2(glm::length(glm::cross(ray.direction, to_center)), glm::dot(ray.direction, to_center));
    const double gap = std::max(0.0, angle - std::asin(targets[i].radius_m / distance));
    if (gap > cone_rad) continue;
    if (gap < best_gap || (gap == best_gap && distance < best_distance)) {
      best = i;
      best_gap = gap;
      best_distance = distance;
    }
  }
  return best;
}

Selector::Result Selector::update(const WandState& wand, std::span<const Target> targets) {
  Result result;
  if (wand.pose_valid) result.hovered = pick(ray_of(wand), kPickConeRad, targets);
  const bool pressed = wand.pose_valid && wand.select_pressed;
  if (pressed && !was_pressed_) result.chosen = result.hovered;
  was_pressed_ = pressed;
  return result;
}

}  // namespace afm::input
