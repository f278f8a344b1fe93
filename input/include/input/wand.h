// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace afm::input {

// What every wand gives, whatever it is made of. Room frame, metres; the ray leaves the wand along its -z.
struct WandState {
  std::int64_t time_ns = 0;
  glm::dvec3 position_m{0.0};
  glm::dquat room_from_wand{1.0, 0.0, 0.0, 0.0};
  bool pose_valid = false;
  bool select_pressed = false;
};

struct Ray {
  glm::dvec3 origin_m{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};  // unit
};

inline Ray ray_of(const WandState& wand) {
  return {.origin_m = wand.position_m, .direction = wand.room_from_wand * glm::dvec3(0.0, 0.0, -1.0)};
}

}  // namespace afm::input
