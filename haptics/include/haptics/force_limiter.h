// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include "haptics/workspace_stop.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

// One tick of the output stage; places and vectors in the device frame, places from the contact point.
struct OutputRequest {
  glm::dvec3 law_force_n{0.0};  // of the scaled model
  glm::dvec3 position_m{0.0};
  glm::dvec3 velocity_m_per_s{0.0};
  double arm_gain = 0;           // 0 to 1; outside, the nearer of them
  double thermal_gain = 1;       // likewise
  double damping_n_s_per_m = 0;  // 0 to ForceLimiter::kMostDampingNSPerM; likewise
  double slew_n_per_s = 0;       // overrides the limiter's slew limit if lower; 0: the force does not change
  double elapsed_s = 0;          // since the tick before, at most one period
  bool too_fast = false;         // the velocity trip
};

// The last thing a force goes through, in this order: finite check, gain of arming, thermal derate, damping,
// end-stop of the workspace, clamp of the vector, slew limit, velocity trip.
//
// Whatever comes in: what goes out is finite, no longer than the cap, and differs from the command before by no more
// than the slew limit allows. Only a cut, to zero and at once, may exceed the slew limit: a hand is safer without any
// force than with one that follows from a number that is none, a device that failed or a hand that flies. Fades stay
// within it.
//
// For the servo's thread; noexcept, allocates nothing. Moves no device: SafetyGovernor does.
class ForceLimiter {
 public:
  static constexpr double kHardCapN = 3.3;           // peak of the strongest device that was thought of
  static constexpr double kMostDampingNSPerM = 4.0;  // more makes a device of this class buzz

  ForceLimiter(double cap_n, double slew_n_per_s, const WorkspaceStop& stop);

  // None, or why the force was cut: NotFinite or VelocityTrip.
  scene::FaultCode step(const OutputRequest& request) noexcept;
  void cut() noexcept;

  const glm::dvec3& command_n() const noexcept { return command_n_; }

  // Force of law and end-stop in that tick, before damping and limits: input of the passivity observer.
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
