// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "input/wand.h"

namespace afm::input {

// Wand in a simulated hand: it rests at a fixed grip and turns towards its target along a minimum-jerk path, with
// natural hand tremor. Deterministic: the state depends only on the script and the times requested. One thread.
class SimulatedWand {
 public:
  explicit SimulatedWand(const glm::dvec3& grip_m);

  // Starts to turn at `now_ns`; arrives after `duration_s`.
  void aim_at(const glm::dvec3& point_m, double duration_s, std::int64_t now_ns);

  // Holds the select button from `now_ns` for `duration_s`.
  void press(double duration_s, std::int64_t now_ns);

  // True once the last aim has been reached.
  bool arrived(std::int64_t now_ns) const;

  WandState state(std::int64_t now_ns) const;

 private:
  glm::dvec3 aim_direction(std::int64_t now_ns) const;

  glm::dvec3 grip_m_;
  glm::dvec3 from_direction_{0.0, 0.0, -1.0};
  glm::dvec3 to_direction_{0.0, 0.0, -1.0};
  std::int64_t aim_start_ns_ = 0;
  std::int64_t aim_end_ns_ = 0;
  std::int64_t press_start_ns_ = 0;
  std::int64_t press_end_ns_ = 0;
};

}  // namespace afm::input
