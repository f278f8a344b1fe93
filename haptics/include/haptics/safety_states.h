// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/shared/shared_blocks.h"

// The servo's states and what moves it from one to another, without the numbers behind it:
//
//   Disarmed --Turn-On pressed, nothing in the way--> Arming --ramp at its top--> Running
//   Arming, Running --a reason to fade--> Fading --no force left--> Disarmed
//   any --the device failed, what it says is no number, or Stop was pressed--> Fault --cause gone, Turn-On pressed-->
//   Disarmed Arming, Running, Fading --the hand flies--> Fault
//
// A device that is missing or not calibrated is one that failed. Nothing but these edges is taken.
namespace afm::haptics {

// Conditions found in one tick.
struct SafetyConditions {
  scene::FaultCode cut = scene::FaultCode::None;  // DeviceError, NotFinite, StopPressed, VelocityTrip
  scene::RendererLink renderer = scene::RendererLink::Absent;
  bool turn_on_edge = false;  // pressed in this tick
  bool turn_on_held = false;
  bool interlock = false;  // lifted, free, still, no force wanted
  bool dead_man = false;   // the force lasts only as long as Turn-On is held
  bool late = false;       // this tick came so late that nobody knows where the hand has been
  bool outside = false;    // of the workspace
  bool hot = false;        // the motors
  bool energy_exceeded = false;
};

struct SafetyState {
  scene::ServoState state = scene::ServoState::Disarmed;
  scene::FaultCode fault = scene::FaultCode::None;  // of the last fade or fault, until the next arming
  std::int64_t fade_ns = 0;                         // while Fading: from full force to none

  bool armed() const noexcept { return state != scene::ServoState::Disarmed && state != scene::ServoState::Fault; }
};

inline constexpr std::int64_t kQuickFadeNs = 20'000'000;
inline constexpr std::int64_t kSlowFadeNs = 90'000'000;

// At the beginning of a tick. A fade under way changes only for a more urgent reason, one that takes less time.
SafetyState after_conditions(const SafetyState& before, const SafetyConditions& conditions) noexcept;

// The force is to go in this time, for `fault` or, with None, in good order. Only while Arming, Running or Fading.
SafetyState begin_fade(const SafetyState& before, std::int64_t fade_ns, scene::FaultCode fault) noexcept;

// At the end of a tick: `gain` is that of arming, `silent` says that no force is commanded.
SafetyState after_output(const SafetyState& before, double gain, bool silent) noexcept;

}  // namespace afm::haptics
