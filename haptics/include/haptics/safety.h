// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "haptics/device.h"
#include "scene/shared_blocks.h"

namespace afm::haptics {

using scene::RendererLink;

// One tick as the governor sees it; hand's values in the device frame.
struct GovernorInput {
  std::int64_t time_ns = 0;
  glm::dvec3 hand_position_m{0.0};
  glm::dvec3 wanted_force_n{0.0};  // of the scaled model, before any limit
  double hand_height_m = 0;        // above the contact point, along the sample's normal
  scene::ContactPhase phase = scene::ContactPhase::WaitForLift;
  bool pulled_off = false;  // in this tick
  bool turn_on = false;
  bool device_healthy = true;
  RendererLink renderer = RendererLink::Absent;
};

// The last thing between a force law and a hand. Owns the servo's state and is the only maker of ForceCommand. For the
// servo's thread: wait-free, never throws.
//
// Disarmed --Turn-On pressed, tip lifted, still and free, renderer alive--> Arming --0.5 s--> Running
// Arming, Running --renderer hung, leaving or dead, a tick > 20 ms late, disarm()--> Fading --force is zero--> Disarmed
// any --not a number, device error, too fast--> Fault --cause gone, Turn-On pressed--> Disarmed
//
// The order of the output stage is fixed: finite check, gain, damping after pull-off, clamp of the vector, slew limit,
// velocity trip. Whatever comes in, what goes out is finite, not longer than the cap, and differs from the command
// before by no more than the slew limit, except that a fault cuts it to zero at once.
class SafetyGovernor {
 public:
  static constexpr double kSlewNPerS = 500.0;
  static constexpr double kGuardSlewNPerS = 100.0;  // for kGuardNs after a tick that came more than two periods late
  static constexpr std::int64_t kGuardNs = 100'000'000;
  static constexpr std::int64_t kLateNs = 20'000'000;  // a tick after this pause disarms
  static constexpr std::int64_t kHangNs = 250'000'000;
  static constexpr std::int64_t kArmingNs = 500'000'000;
  static constexpr std::int64_t kQuickFadeNs = 20'000'000;
  static constexpr std::int64_t kFadeNs = 90'000'000;  // with kHangNs less than 350 ms from the last heartbeat to zero
  static constexpr double kArmingMarginM = 0.005;      // above the height at which the tip lets go
  static constexpr double kArmingForceN = 0.05;
  static constexpr double kArmingSpeedMPerS = 0.1;
  static constexpr double kTripSpeedMPerS = 0.8;  // a relaxed hand reaches 0.6 m/s after pull-off
  static constexpr std::int64_t kTripNs = 5'000'000;
  static constexpr double kReleaseDampingNSPerM = 3.0;
  static constexpr std::int64_t kReleaseDampingNs = 100'000'000;

  struct Output {
    ForceCommand command;
    bool dropped = false;  // the force was just taken away: the model has to wait for a lift
  };

  // `cap_n`: the longest force vector. `release_height_m`: hand height at which the tip lets go (FitScaling::kStrokeM).
  // `slew_n_per_s`: less than kSlewNPerS for a device that stands less.
  SafetyGovernor(std::int64_t period_ns, double cap_n, double release_height_m, double slew_n_per_s = kSlewNPerS);

  Output step(const GovernorInput& input) noexcept;

  // Takes the force away in kQuickFadeNs; a new Turn-On is needed. For a change of material.
  void disarm() noexcept { begin_fade(kQuickFadeNs, scene::FaultCode::None); }

  // What the hand did before no longer counts, except for the state: for a change of material, so that what follows
  // depends on nothing that a recording of it does not hold. Only while released().
  void forget_motion() noexcept;

  scene::ServoState state() const noexcept { return state_; }
  scene::FaultCode fault() const noexcept { return fault_; }
  bool released() const noexcept;  // no force, and none to come without a new Turn-On

 private:
  void begin_fade(std::int64_t duration_ns, scene::FaultCode code) noexcept;
  Output cut(scene::FaultCode code) noexcept;
  void estimate_velocity(const glm::dvec3& position_m, double seconds) noexcept;
  bool may_arm(const GovernorInput& input) const noexcept;
  void follow_renderer(RendererLink link) noexcept;
  void advance_state(const GovernorInput& input, std::int64_t elapsed_ns, bool turn_on_edge) noexcept;
  glm::dvec3 limited(const GovernorInput& input, std::int64_t elapsed_ns) noexcept;
  bool too_fast(std::int64_t now_ns) noexcept;

  std::int64_t period_ns_;
  double cap_n_;
  double release_height_m_;
  double slew_n_per_s_;

  scene::ServoState state_ = scene::ServoState::Disarmed;
  scene::FaultCode fault_ = scene::FaultCode::None;
  double gain_ = 0;
  bool fade_begins_ = false;
  std::int64_t fade_duration_ns_ = kFadeNs;
  std::int64_t guard_until_ns_ = 0;
  std::int64_t damping_until_ns_ = 0;
  std::int64_t fast_since_ns_ = 0;
  bool fast_ = false;

  bool started_ = false;
  bool turn_on_before_ = true;  // a button that is held from the beginning is no press
  std::int64_t time_ns_ = 0;
  glm::dvec3 position_m_{0.0};
  glm::dvec3 velocity_m_per_s_{0.0};
  glm::dvec3 command_n_{0.0};
};

}  // namespace afm::haptics
