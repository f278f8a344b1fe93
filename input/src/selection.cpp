// SPDX-License-Identifier: Apache-2.0
#include "input/selection.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace afm::input {

namespace {

// Angle from the ray to the target's silhouette, negative inside it; empty if the ray starts inside the target, or for
// NaN.
std::optional<double> angle_to_silhouette(const Ray& ray, const Target& target) {
  const glm::dvec3 to_center = target.center_m - ray.origin_m;
  const double distance = glm::length(to_center);
  if (!(distance > target.radius_m)) return std::nullopt;

  // atan2 of cross and dot stays exact at small angles, unlike acos of the dot product
  const double angle =
      std::atan2(glm::length(glm::cross(ray.direction, to_center)), glm::dot(ray.direction, to_center));
  return angle - std::asin(target.radius_m / distance);
}

template <class Allowed>
std::optional<std::size_t> nearest(const Ray& ray, double cone_rad, std::span<const Target> targets,
                                   const Allowed& allowed) {
  std::optional<std::size_t> best;
  double best_gap = std::numeric_limits<double>::infinity();
  double best_distance = best_gap;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto angle = angle_to_silhouette(ray, targets[i]);
    if (!angle || !allowed(i)) continue;
    const double gap = std::max(0.0, *angle);
    if (!(gap <= cone_rad)) continue;
    const double distance = glm::distance(ray.origin_m, targets[i].center_m);
    if (gap < best_gap || (gap == best_gap && distance < best_distance)) {
      best = i;
      best_gap = gap;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace

std::optional<std::size_t> pick(const Ray& ray, double cone_rad, std::span<const Target> targets) {
  return nearest(ray, cone_rad, targets, [](std::size_t) { return true; });
}

bool seen_from(const glm::dvec3& eye_m, std::size_t target, std::span<const Target> targets) {
  const glm::dvec3 sight = targets[target].center_m - eye_m;
  const double length2 = glm::dot(sight, sight);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    if (i == target) continue;
    const double along = glm::dot(targets[i].center_m - eye_m, sight) / length2;
    if (!(along > 0.0 && along < 1.0)) continue;
    if (glm::distance(eye_m + along * sight, targets[i].center_m) < targets[i].radius_m) return false;
  }
  return true;
}

Selector::Result Selector::update(const WandState& wand, const glm::dvec3& eye_m, std::span<const Target> targets) {
  Result result;
  if (wand.orientation_valid) {
    const Ray ray = ray_of(wand);
    const auto seen = [&](std::size_t i) { return seen_from(eye_m, i, targets); };
    result.hovered = nearest(ray, kPickConeRad, targets, seen);
    if (result.hovered && hovered_ && result.hovered != hovered_ && *hovered_ < targets.size() && seen(*hovered_)) {
      const auto before = angle_to_silhouette(ray, targets[*hovered_]);
      const auto now = angle_to_silhouette(ray, targets[*result.hovered]);
      if (before && *before <= kPickConeRad && *now + kStickRad > *before) result.hovered = hovered_;
    }
  }
  hovered_ = result.hovered;

  // a button held while the pose is lost is not a new press
  const bool pressed = wand.pressed(WandButton::Select);
  if (pressed && !was_pressed_) result.chosen = result.hovered;
  was_pressed_ = pressed;
  return result;
}

}  // namespace afm::input
