// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

namespace afm::haptics {

// A soft wall before the mechanical end of a device's workspace: over the last 5 mm of every axis a spring and a damper
// push the hand back. 0.75 N at the end are felt without hurting, and the damper is ample: at 1 kHz a wall is passive
// from 150 N/m * 1 ms / 2 = 0.08 N s/m on (Colgate & Schenkel 1997).
//
// Places are in the frame of `min_m` and `max_m`. An axis that is shorter than four such walls, of a device that does
// not really move that way, has none. Beyond the workspace the spring goes on; the governor's clamp ends it.
class WorkspaceStop {
 public:
  static constexpr double kDepthM = 0.005;
  static constexpr double kStiffnessNPerM = 150.0;
  static constexpr double kDampingNSPerM = 2.0;
  static constexpr double kOutsideM = 0.010;  // so far outside the wall has failed to hold the hand

  WorkspaceStop(const glm::dvec3& min_m, const glm::dvec3& max_m) : min_m_(min_m), max_m_(max_m) {}

  // Spring alone: the part that gives back what it takes.
  glm::dvec3 spring_n(const glm::dvec3& position_m) const noexcept;

  // Spring and damper; never outwards, so that no hand sticks to the wall.
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
