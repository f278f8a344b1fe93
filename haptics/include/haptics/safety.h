// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>

#include "haptics/device.h"
#include "haptics/force_limiter.h"
#include "haptics/hand_motion.h"
#include "haptics/motor_thermal_model.h"
#include "haptics/passivity_observer.h"
#include "haptics/safety_states.h"
#include "scene/shared/shared_blocks.h"

namespace afm::haptics {

using scene::RendererLink;

// Limits that protect a hand, a device and its motors.
struct SafetyLimits {
  std::int64_t period_ns = 1'000'000;
  double force_cap_n = 2.0;  // length of the largest force vector
  double slew_n_per_s = 500.0;
  double trip_speed_m_per_s = 0.8;  // speed of the velocity trip; a relaxed hand reaches 0.6 m/s after pull-off
  double continuous_force_n = 0;    // continuous rating of the motors; 0: unknown
  double release_height_m = 0.050;  // height of the hand at which the tip detaches
  glm::dvec3 workspace_min_m{0.0};  // corner of the workspace, from the contact point
  glm::dvec3 workspace_max_m{0.0};
  bool dead_man = false;
};

// Limits for a device: its own limits reduced to kUsableLimitShare, or TouchAFM's where those are lower.
SafetyLimits safety_limits(const DeviceSpec& device, std::int64_t period_ns, double release_height_m, bool dead_man);

// One tick as the governor sees it; the hand's values in the device frame, from the contact point.
struct GovernorInput {
  std::int64_t time_ns = 0;
  glm::dvec3 hand_position_m{0.0};
  glm::dvec3 wanted_force_n{0.0};  // force of the scaled model, before any limit
  double hand_height_m = 0;        // height above the surface below the tip, on the scale of the release height
  physics::Phase phase = physics::Phase::WaitForLift;
  bool pulled_off = false;  // true: the tip pulled off in this tick
  bool turn_on = false;
  bool device_healthy = true;
  double motor_heat = 0;  // heat as in DeviceSample
  RendererLink renderer = RendererLink::Absent;
  PassivityObserver::Law law_energy;  // observer's input for this height and phase
  bool sample_moved = false;          // true: another hand moved the sample since the previous tick
  bool led = false;                   // true: a scan leads the hand (haptics/scan_guide.h), and the force law is silent
  double damping_n_s_per_m = 0;       // requested damping
};

// Last stage between a force law and a hand. Owns the servo's state (haptics/safety_states.h), and is the only creator
// of ForceCommand, after haptics/force_limiter.h. Servo's thread: wait-free, never throws.
class SafetyGovernor {
 public:
  static constexpr double kSlewNPerS = 500.0;
  static constexpr double kGuardSlewNPerS = 100.0;  // slew limit for kGuardNs after a tick more than two periods late
  static constexpr std::int64_t kGuardNs = 100'000'000;
  static constexpr std::int64_t kLateNs = 20'000'000;   // lateness of a tick that disarms
  static constexpr std::int64_t kHangNs = 250'000'000;  // allowed age of a heartbeat; with kSlowFadeNs 340 ms to zero
  static constexpr std::int64_t kArmingNs = 500'000'000;
  static constexpr double kArmingMarginM = 0.005;  // distance above the height at which the tip detaches
  static constexpr double kArmingForceN = 0.05;
  static constexpr double kArmingSpeedMPerS = 0.1;
  static constexpr double kTripSpeedMPerS = 0.8;
  static constexpr double kReleaseDampingNSPerM = 3.0;
  static constexpr std::int64_t kReleaseDampingNs = 100'000'000;

  struct Output {
    ForceCommand command;
    bool dropped = false;  // true: the force was just removed, and the model must wait for a lift
  };

  explicit SafetyGovernor(const SafetyLimits& limits);

  Output step(const GovernorInput& input) noexcept;

  // Removes the force within kQuickFadeNs; a new Turn-On is needed. Used for a change of material.
  void disarm() noexcept { state_ = begin_fade(state_, kQuickFadeNs, scene::FaultCode::None); }

  // Used for another material or scale. Call only while released().
  void set_release_height(double release_height_m) noexcept { release_height_m_ = release_height_m; }

  // Discards the past motion but keeps the state and the heat, for a change of material: the following ticks then
  // depend only on the contents of their recording. Call only while released().
  void forget_motion() noexcept;

  scene::ServoState state() const noexcept { return state_.state; }
  scene::FaultCode fault() const noexcept { return state_.fault; }
  bool released() const noexcept;  // true: no force, and none without a new Turn-On

  double force_cap_n() const noexcept { return output_.cap_n(); }
  double slew_limit_n_per_s() const noexcept { return slew_n_per_s_; }  // slew limit in this tick
  const MotorThermalModel& motors() const noexcept { return motors_; }
  const PassivityObserver& observer() const noexcept { return observer_; }
  double observer_damping_n_s_per_m() const noexcept { return observer_damping_; }  // damping in this tick
  bool dead_man() const noexcept { return dead_man_; }

 private:
  // State of the previous tick for the passivity observer.
  struct Snapshot {
    bool valid = false;
    double law_gain = 0;
    double stop_gain = 0;
    physics::Phase phase = physics::Phase::WaitForLift;
    bool led = false;
    PassivityObserver::Law law;
    double stop_stored_j = 0;
  };

  SafetyConditions evaluate(const GovernorInput& input, std::int64_t elapsed_ns) noexcept;
  void observe_energy(const GovernorInput& input) noexcept;
  bool high_and_free(const GovernorInput& input) const noexcept;
  void advance_gain(std::int64_t elapsed_ns) noexcept;
  scene::FaultCode limit_force(const GovernorInput& input, std::int64_t elapsed_ns) noexcept;
  void remember(const GovernorInput& input) noexcept;

  std::int64_t period_ns_;
  double release_height_m_;
  bool dead_man_;

  SafetyState state_;
  double gain_ = 0;  // arming gain
  bool fade_under_way_ = false;
  ForceLimiter output_;
  HandMotion motion_;
  MotorThermalModel motors_;
  PassivityObserver observer_;
  Snapshot previous_;
  double observer_damping_ = 0;
  double slew_n_per_s_;

  std::int64_t guard_until_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t damping_until_ns_ = std::numeric_limits<std::int64_t>::min();
  bool started_ = false;
  bool turn_on_before_ = true;  // initially true, because a button held from the beginning is not a press
  std::int64_t time_ns_ = 0;
};

}  // namespace afm::haptics
