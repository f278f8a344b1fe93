// SPDX-License-Identifier: Apache-2.0
#include "haptics/workspace_stop.h"

#include <algorithm>
#include <cmath>

namespace afm::haptics {

double WorkspaceStop::depth_m(int axis, double position_m) const noexcept {
  if (!(max_m_[axis] - min_m_[axis] >= 4.0 * kDepthM)) return 0.0;
  return std::max(0.0, position_m - (max_m_[axis] - kDepthM)) - std::max(0.0, (min_m_[axis] + kDepthM) - position_m);
}

glm::dvec3 WorkspaceStop::spring_n(const glm::dvec3& position_m) const noexcept {
  glm::dvec3 force_n(0.0);
  for (int axis = 0; axis < 3; ++axis) force_n[axis] = -kStiffnessNPerM * depth_m(axis, position_m[axis]);
  return force_n;
}

glm::dvec3 WorkspaceStop::force_n(const glm::dvec3& position_m, const glm::dvec3& velocity_m_per_s) const noexcept {
  glm::dvec3 force_n = spring_n(position_m);
  for (int axis = 0; axis < 3; ++axis) {
    if (force_n[axis] == 0.0) continue;
    const double damped_n = force_n[axis] - kDampingNSPerM * velocity_m_per_s[axis];
    force_n[axis] = force_n[axis] > 0.0 ? std::max(0.0, damped_n) : std::min(0.0, damped_n);
  }
  return force_n;
}

double WorkspaceStop::stored_j(const glm::dvec3& position_m) const noexcept {
  double sum_m2 = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double depth = depth_m(axis, position_m[axis]);
    sum_m2 += depth * depth;
  }
  return 0.5 * kStiffnessNPerM * sum_m2;
}

bool WorkspaceStop::is_outside(const glm::dvec3& position_m) const noexcept {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(depth_m(axis, position_m[axis])) > kDepthM + kOutsideM) return true;
  }
  return false;
}

}  // namespace afm::haptics
