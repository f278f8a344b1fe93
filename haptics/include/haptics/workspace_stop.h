// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace afm::haptics {

// Soft wall before the mechanical end of a device's workspace: over the last 5 mm of every axis, a spring and a damper
// push the hand back. 0.75 N at the end is felt without hurting, and the damping is ample: at 1 kHz a wall is passive
// with at least 150 N/m * 1 ms / 2 = 0.08 N s/m (Colgate & Schenkel 1997).
//
// Positions are in the frame of `min_m` and `max_m`. An axis shorter than four such walls, on a device that hardly
// moves along it, has none. Beyond the workspace the spring continues; the governor's clamp limits it.
class WorkspaceStop {
 public:
  static constexpr double kDepthM = 0.005;
  static constexpr double kStiffnessNPerM = 150.0;
  static constexpr double kDampingNSPerM = 2.0;
  static constexpr double kOutsideM = 0.010;  // distance outside at which the wall has failed to hold the hand

  WorkspaceStop(const glm::dvec3& min_m, const glm::dvec3& max_m) : min_m_(min_m), max_m_(max_m) {}

  // Force of the spring only, the conservative part.
  glm::dvec3 spring_n(const glm::dvec3& position_m) const noexcept;

  // Force of spring and damper; never outwards, so that no hand sticks to the wall.
  glm::dvec3 force_n(const glm::dvec3& position_m, const glm::dvec3& velocity_m_per_s) const noexcept;

  // Potential of the spring.
  double stored_j(const glm::dvec3& position_m) const noexcept;

  bool is_outside(const glm::dvec3& position_m) const noexcept;

 private:
  // Penetration of the hand into an end-stop of this axis: positive at the upper end, negative at the lower.
  double depth_m(int axis, double position_m) const noexcept;

  glm::dvec3 min_m_;
  glm::dvec3 max_m_;
};

}  // namespace afm::haptics
