// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "haptics/device.h"

namespace afm::haptics {

// Checks that a sensor's positions can be those of a hand, before any force is computed from them.
//
// - Skips a position that no hand can have reached since the last accepted one, which then stays in use for some ticks.
//   If the next positions are impossible too, the device is not healthy.
// - Detects a position that stays the same to the last bit for kStuckNs under force, where a sensor held by a living
//   hand would flicker. The device is then not healthy.
//
// Applies only to devices that measure. Servo's thread: never throws, allocates nothing.
class PositionCheck {
 public:
  static constexpr double kFastestMPerS = 2.0;              // largest speed of a hand; the velocity trip is at 0.8 m/s
  static constexpr double kSlackM = 0.5e-3;                 // tolerance for encoders and clocks
  static constexpr std::int64_t kLongestGapNs = 8'000'000;  // longest time between two positions of a working device
  static constexpr std::int64_t kStuckNs = 1'000'000'000;
  static constexpr double kStuckForceN = 0.05;

  explicit PositionCheck(bool measured) : measured_(measured) {}

  // Sample to continue with. `elapsed_ns` is the time since the previous call; `force_n` is the force sent then.
  DeviceSample checked(DeviceSample sample, std::int64_t elapsed_ns, const glm::dvec3& force_n) noexcept;

 private:
  static constexpr int kImpossible = 2, kPossible = -1, kMost = 8;

  bool is_possible(const glm::dvec3& position_m, std::int64_t elapsed_ns) const noexcept;

  bool measured_;
  bool started_ = false;
  glm::dvec3 read_m_{0.0};
  glm::dvec3 believed_m_{0.0};
  std::int64_t forced_ns_ = 0;    // time under force since the last change of the position
  std::int64_t believed_ns_ = 0;  // time since the last plausible position
  int doubt_ = 0;
};

}  // namespace afm::haptics
