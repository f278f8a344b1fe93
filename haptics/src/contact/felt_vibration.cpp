// SPDX-License-Identifier: Apache-2.0
#include "contact/felt_vibration.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "haptics/scaling.h"

namespace afm::haptics {

FeltVibration::FeltVibration(const DeviceSpec& device)
    : most_n_(std::min(kMostVibrationN, device.max_vibration_n)),
      stiffness_n_per_m_(kShareOfStiffness * std::min(Scaling::kMaxStiffnessNPerM, device.max_stiffness_n_per_m)) {}

glm::dvec3 FeltVibration::step(const glm::dvec3& hand_m, double strength, double room_n, double elapsed_s) noexcept {
  // written so that NaN rests
  const bool felt = most_n_ > 0.0 && strength > 0.0;
  if (!felt) {
    rest();
    return glm::dvec3(0.0);
  }
  if (!anchor_m_) {
    // begins with the limit at zero, whatever the time since the previous step
    anchor_m_ = hand_m;
    phase_ = stored_j_ = 0.0;
    return glm::dvec3(0.0);
  }
  phase_ += kPerS * elapsed_s;
  phase_ -= std::floor(phase_);
  const double share = std::min(strength, 1.0) * (0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * phase_));
  const double limit_n = std::max(0.0, std::min(share * most_n_, room_n));
  const glm::dvec3 stretched_m = hand_m - *anchor_m_;
  const double pull_n = stiffness_n_per_m_ * glm::length(stretched_m);
  const double kept = pull_n > limit_n ? limit_n / pull_n : 1.0;
  const glm::dvec3 left_m = kept * stretched_m;
  anchor_m_ = hand_m - left_m;
  stored_j_ = 0.5 * stiffness_n_per_m_ * glm::dot(left_m, left_m);
  return -stiffness_n_per_m_ * left_m;
}

}  // namespace afm::haptics
