// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "haptics/workspace_stop.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// Input of the output stage in one tick; vectors in the device frame, positions from the contact point.
struct OutputRequest {
  glm::dvec3 law_force_n{0.0};  // force of the scaled model
  glm::dvec3 position_m{0.0};
  glm::dvec3 velocity_m_per_s{0.0};
  double arm_gain = 0;           // gain of the arming ramp, clamped to 0..1
  double thermal_gain = 1;       // gain of the thermal derating, clamped to 0..1
  double damping_n_s_per_m = 0;  // requested damping, clamped to 0..ForceLimiter::kMostDampingNSPerM
  double slew_n_per_s = 0;       // slew limit of this tick if lower than the limiter's; 0: the force stays constant
  double elapsed_s = 0;          // time since the previous tick, at most one period
  bool too_fast = false;         // true: velocity trip
};

// Last stage of every force, in this order: finite check, arming gain, thermal derating, damping, workspace end-stop,
// clamp of the vector, slew limit, velocity trip.
//
// For any input, the output is finite, no longer than the cap, and differs from the previous command by no more than
// the slew limit allows. Only a cut, to zero and at once, may exceed the slew limit: for a hand, no force is safer than
// one computed from an invalid number, by a failed device, or for a hand that flies off. Fades stay within the limit.
//
// Servo's thread; noexcept, allocates nothing. Does not move a device; SafetyGovernor does.
class ForceLimiter {
 public:
  static constexpr double kHardCapN = 3.3;           // peak force of the strongest device considered
  static constexpr double kMostDampingNSPerM = 4.0;  // limit above which a device of this class buzzes

  ForceLimiter(double cap_n, double slew_n_per_s, const WorkspaceStop& stop);

  // Returns None, or the reason for cutting the force: NotFinite or VelocityTrip.
  scene::FaultCode step(const OutputRequest& request) noexcept;
  void cut() noexcept;

  const glm::dvec3& command_n() const noexcept { return command_n_; }

  // Force of law and end-stop in that tick, before damping and limits; input of the passivity observer.
  const glm::dvec3& wanted_n() const noexcept { return wanted_n_; }

  double cap_n() const noexcept { return cap_n_; }
  double slew_n_per_s() const noexcept { return slew_n_per_s_; }
  const WorkspaceStop& stop() const noexcept { return stop_; }

 private:
  double cap_n_;
  double slew_n_per_s_;
  WorkspaceStop stop_;
  glm::dvec3 wanted_n_{0.0};
  glm::dvec3 command_n_{0.0};
};

}  // namespace afm::haptics
