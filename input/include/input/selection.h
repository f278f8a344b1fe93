// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "input/wand.h"

namespace afm::input {

// Something to point at, as a sphere in the room.
struct Target {
  glm::dvec3 center_m{0.0};
  double radius_m = 0.1;
};

// The target whose silhouette is angularly nearest to the ray, if it lies within `cone_rad` of it; among those that the
// ray hits, the nearest to the wand. The bubble ray of Lu, Yu and Shi (2020) with angular distance.
std::optional<std::size_t> pick(const Ray& ray, double cone_rad, std::span<const Target> targets);

// True if no other target hides the middle of a target from the eye. A target that the hand can point at but the eye
// cannot see is not the intended one (Argelaguet and Andujar 2009).
bool seen_from(const glm::dvec3& eye_m, std::size_t target, std::span<const Target> targets);

// Turns pointing and pressing into a choice: a target is chosen when the select button goes down while the ray is on
// it. Of the targets that the eye sees, the ray snaps to the nearest within kPickConeRad, and lets it go for another
// only when that one is nearer by kStickRad: a hand that trembles between two of them does not flicker.
class Selector {
 public:
  struct Result {
    std::optional<std::size_t> hovered;
    std::optional<std::size_t> chosen;  // only in the frame of the press
  };

  // Once a frame; the targets keep their order. A wand that points nowhere hovers nothing and chooses nothing.
  Result update(const WandState& wand, const glm::dvec3& eye_m, std::span<const Target> targets);

 private:
  std::optional<std::size_t> hovered_;
  bool was_pressed_ = false;
};

// Snapping distance of the bubble ray.
inline constexpr double kPickConeRad = 5.0 * 3.14159265358979323846 / 180.0;
// Twice the jitter of a hand at rest (0.5 degrees RMS, tests/input/simulated_user_test.cpp).
inline constexpr double kStickRad = 1.0 * 3.14159265358979323846 / 180.0;

}  // namespace afm::input
