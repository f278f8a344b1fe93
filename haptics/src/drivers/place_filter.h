// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace afm::haptics {

// Rejects positions of a driver at which no hand can be: not a number, far outside the workspace, or a leap from the
// previous one. One thread.
class PlaceFilter {
 public:
  // Largest plausible motion in one period of a driver, in which a hand moves a millimetre at most. The figures for the
  // workspace have some tolerance as well.
  static constexpr double kLongestLeapM = 0.05;
  static constexpr double kWorkspacePlayM = 0.1;

  PlaceFilter(const glm::dvec3& min_m, const glm::dvec3& max_m) : min_m_(min_m), max_m_(max_m) {}

  // True if the hand can be there. After a leap, the next positions are compared with the new one.
  bool accepts(const glm::dvec3& position_m) noexcept {
    for (int axis = 0; axis < 3; ++axis) {
      // NaN compares false
      if (!(position_m[axis] >= min_m_[axis] - kWorkspacePlayM && position_m[axis] <= max_m_[axis] + kWorkspacePlayM))
        return false;
    }
    const bool leapt = known_ && glm::length(position_m - last_m_) > kLongestLeapM;
    last_m_ = position_m;
    known_ = true;
    return !leapt;
  }

 private:
  glm::dvec3 min_m_;
  glm::dvec3 max_m_;
  glm::dvec3 last_m_{0.0};
  bool known_ = false;
};

}  // namespace afm::haptics
