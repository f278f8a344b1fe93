// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "input/hid_report.h"

namespace afm::input {

inline constexpr glm::dvec3 kUp(0.0, 1.0, 0.0);  // upward direction in the level frame and the room

// Orientation of a wand from its gyroscope and accelerometer: the explicit complementary filter of Mahony, Hamel and
// Pflimlin (2008), with gravity as its only reference. Tilt is absolute; heading starts at zero and drifts with the
// residual bias of the gyroscope, which is measured whenever the wand lies still. One thread.
class OrientationFilter {
 public:
  // `duration_s` > 0 is the time since the previous sample. Without a gyroscope, the tilt follows gravity and the
  // heading stays.
  void add(const ImuSample& sample, double duration_s, bool has_gyro = true);

  bool valid() const { return started_; }
  const glm::dquat& level_from_wand() const { return level_from_wand_; }

  // Angle about +y from -z to the pointing direction; 0 if it is vertical.
  double heading_rad() const;

 private:
  void start(const glm::dvec3& up);
  void watch_rest(const ImuSample& sample, double duration_s);

  glm::dquat level_from_wand_{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 bias_{0.0};
  bool started_ = false;

  // extremes and sums over the current observation period
  glm::dvec3 rate_low_{0.0}, rate_high_{0.0}, rate_sum_{0.0};
  glm::dvec3 pull_low_{0.0}, pull_high_{0.0};
  double watched_s_ = 0.0;
  int watched_samples_ = 0;
};

}  // namespace afm::input
