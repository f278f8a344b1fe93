// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "input/wand.h"

namespace afm::input {

// Target for pointing: a sphere in the room.
struct Target {
  glm::dvec3 center_m{0.0};
  double radius_m = 0.1;
};

// Target whose silhouette has the smallest angle to the ray, if that is within `cone_rad`; among targets hit by the
// ray, the one nearest to the wand. This is the bubble ray of Lu, Yu and Shi (2020) with angular distance.
std::optional<std::size_t> pick(const Ray& ray, double cone_rad, std::span<const Target> targets);

// True if no other target hides the centre of a target from the eye. A target that the hand can point at but the eye
// cannot see is not the intended one (Argelaguet and Andujar 2009).
bool seen_from(const glm::dvec3& eye_m, std::size_t target, std::span<const Target> targets);

// Turns pointing and pressing into a choice: pressing the select button chooses the target under the ray. The ray snaps
// to the nearest visible target within kPickConeRad, and switches to another only if that is nearer by kStickRad, so
// that a hand that trembles between two targets does not make it flicker.
class Selector {
 public:
  struct Result {
    std::optional<std::size_t> hovered;
    std::optional<std::size_t> chosen;  // chosen target, set only in the frame of the press
  };

  // Call once per frame; the targets keep their order. A wand that points nowhere neither hovers nor chooses.
  Result update(const WandState& wand, const glm::dvec3& eye_m, std::span<const Target> targets);

 private:
  std::optional<std::size_t> hovered_;
  bool was_pressed_ = false;
};

// Angle to a target's silhouette within which the bubble ray snaps to it.
inline constexpr double kPickConeRad = 5.0 * 3.14159265358979323846 / 180.0;
// Twice the noise of a hand at rest (0.5 degrees RMS, tests/input/simulated_user_test.cpp).
inline constexpr double kStickRad = 1.0 * 3.14159265358979323846 / 180.0;

}  // namespace afm::input
