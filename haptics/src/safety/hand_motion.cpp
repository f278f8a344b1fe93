// SPDX-License-Identifier: Apache-2.0
#include "haptics/hand_motion.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "core/check.h"

namespace afm::haptics {

namespace {
constexpr double kPi = 3.14159265358979323846;
}

HandMotion::HandMotion(double trip_speed_m_per_s) : trip_speed_m_per_s_(trip_speed_m_per_s) {
  AFM_CHECK(trip_speed_m_per_s > 0);
}

void HandMotion::move(const glm::dvec3& position_m, std::int64_t elapsed_ns) noexcept {
  moved_m_ = started_ ? position_m - position_m_ : glm::dvec3(0.0);
  position_m_ = position_m;
  started_ = true;
  const double elapsed_s = 1e-9 * static_cast<double>(elapsed_ns);
  if (elapsed_s > 0) {
    const double weight = -std::expm1(-2.0 * kPi * kCutoffHz * elapsed_s);
    velocity_m_per_s_ += weight * (moved_m_ / elapsed_s - velocity_m_per_s_);
  }
  const bool fast = glm::length(velocity_m_per_s_) > trip_speed_m_per_s_;
  fast_ns_ = fast && fast_ ? fast_ns_ + elapsed_ns : 0;
  fast_ = fast;
}

void HandMotion::forget() noexcept {
  started_ = fast_ = false;
  fast_ns_ = 0;
  moved_m_ = velocity_m_per_s_ = glm::dvec3(0.0);
}

}  // namespace afm::haptics
