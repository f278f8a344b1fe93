// SPDX-License-Identifier: Apache-2.0
#include "input/orientation_filter.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/quaternion.hpp>

namespace afm::input {

namespace {

constexpr double kGravityGainPerS = 0.8;      // rate at which the tilt follows gravity, next to a gyroscope
constexpr double kGravityAlonePerS = 10.0;    // rate without a gyroscope
constexpr double kGravityToleranceG = 0.15;   // deviation from 1 g up to which an acceleration indicates the vertical
constexpr double kRestS = 0.5;                // shortest stillness that counts as rest
constexpr double kRestRateRadPerS = 0.05;     // peak to peak at rest: above a gyroscope's noise, below a hand's tremor
constexpr double kRestPullG = 0.05;           // peak to peak: above an accelerometer's noise, below a hand's tremor
constexpr double kLargestBiasRadPerS = 0.35;  // largest bias, 20 degrees per second: more is a steady turn

glm::dquat turned_by(const glm::dvec3& angle) {
  const double length = glm::length(angle);
  return length > 0.0 ? glm::angleAxis(length, angle / length) : glm::dquat(1.0, 0.0, 0.0, 0.0);
}

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void OrientationFilter::add(const ImuSample& sample, double duration_s, bool has_gyro) {
  if (!finite(sample.rate_rad_per_s) || !finite(sample.acceleration_g) || !(duration_s > 0.0)) return;
  const double pull = glm::length(sample.acceleration_g);
  const bool shows_down = std::abs(pull - 1.0) < kGravityToleranceG;
  if (!started_) {
    if (shows_down) start(sample.acceleration_g / pull);
    return;
  }
  if (has_gyro) watch_rest(sample, duration_s);

  glm::dvec3 rate = has_gyro ? sample.rate_rad_per_s - bias_ : glm::dvec3(0.0);
  if (shows_down) {
    const glm::dvec3 up = glm::inverse(level_from_wand_) * kUp;
    rate += (has_gyro ? kGravityGainPerS : kGravityAlonePerS) * glm::cross(sample.acceleration_g / pull, up);
  }
  level_from_wand_ = glm::normalize(level_from_wand_ * turned_by(rate * duration_s));
}

double OrientationFilter::heading_rad() const {
  const glm::dvec3 forward = level_from_wand_ * glm::dvec3(0.0, 0.0, -1.0);
  if (std::hypot(forward.x, forward.z) < 1e-6) return 0.0;
  return std::atan2(-forward.x, -forward.z);
}

// Starts with the shortest rotation that brings the measured direction to +y, then zeroes the heading.
void OrientationFilter::start(const glm::dvec3& up) {
  level_from_wand_ = glm::rotation(up, kUp);
  level_from_wand_ = glm::angleAxis(-heading_rad(), kUp) * level_from_wand_;
  started_ = true;
}

void OrientationFilter::watch_rest(const ImuSample& sample, double duration_s) {
  const glm::dvec3& rate = sample.rate_rad_per_s;
  const glm::dvec3& acceleration = sample.acceleration_g;
  if (watched_samples_ == 0) {
    rate_low_ = rate_high_ = rate;
    pull_low_ = pull_high_ = acceleration;
    rate_sum_ = glm::dvec3(0.0);
    watched_s_ = 0.0;
  }
  rate_low_ = glm::min(rate_low_, rate);
  rate_high_ = glm::max(rate_high_, rate);
  pull_low_ = glm::min(pull_low_, acceleration);
  pull_high_ = glm::max(pull_high_, acceleration);
  rate_sum_ += rate;
  watched_s_ += duration_s;
  ++watched_samples_;

  const glm::dvec3 rate_range = rate_high_ - rate_low_, pull_range = pull_high_ - pull_low_;
  const bool moved = std::max({rate_range.x, rate_range.y, rate_range.z}) > kRestRateRadPerS ||
                     std::max({pull_range.x, pull_range.y, pull_range.z}) > kRestPullG;
  if (!moved && watched_s_ < kRestS) return;
  const glm::dvec3 mean = rate_sum_ / static_cast<double>(watched_samples_);
  if (!moved && glm::length(mean) < kLargestBiasRadPerS) bias_ = mean;
  watched_samples_ = 0;
}

}  // namespace afm::input
