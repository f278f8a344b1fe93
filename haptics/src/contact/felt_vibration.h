// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "haptics/device.h"

namespace afm::haptics {

// A vibration that a moving hand feels: a drag that comes and goes kPerS times a second, at most kMostVibrationN
// strong, on devices whose profile allows it (DeviceSpec::max_vibration_n).
//
// It only takes energy. A spring connects the hand to an anchor that follows where the spring would pull harder than a
// limit, which rises and falls. A falling limit moves the anchor towards the hand and discards energy of the spring; a
// rising one moves nothing. The spring thus returns no more than the hand has stored in it, on any path and at any rate
// of the limit. A hand at rest feels no vibration.
//
// Servo's thread: wait-free, allocates nothing.
class FeltVibration {
 public:
  static constexpr double kPerS = 100.0;             // rate that is felt well, with ten ticks a period
  static constexpr double kShareOfStiffness = 0.25;  // share of the stiffness that the device renders

  explicit FeltVibration(const DeviceSpec& device);

  // Force on the hand at this position, no longer than `room_n`; `strength` is 0 to 1, and `elapsed_s` the time since
  // the previous step. The first step after a rest feels nothing.
  glm::dvec3 step(const glm::dvec3& hand_m, double strength, double room_n, double elapsed_s) noexcept;
  void rest() noexcept { anchor_m_.reset(); }

  // Energy in the spring, and its stiffness, 0 at rest.
  double stored_j() const noexcept { return anchor_m_ ? stored_j_ : 0.0; }
  double stiffness_n_per_m() const noexcept { return anchor_m_ ? stiffness_n_per_m_ : 0.0; }

 private:
  double most_n_;
  double stiffness_n_per_m_;
  std::optional<glm::dvec3> anchor_m_;  // anchor of the spring; empty: at rest
  double phase_ = 0;                    // phase as a fraction of a period
  double stored_j_ = 0;
};

}  // namespace afm::haptics
