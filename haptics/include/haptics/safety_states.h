// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/shared/shared_blocks.h"

// States of the servo and the transitions between them, without the underlying numbers:
//
//   Disarmed --Turn-On pressed, no obstacle--> Arming --ramp complete--> Running
//   Arming, Running --a reason to fade--> Fading --no force left--> Disarmed
//   any --device failed, invalid numbers, or Stop pressed--> Fault --cause gone, Turn-On pressed--> Disarmed
//   Arming, Running, Fading --hand flies off--> Fault
//
// A device that is missing or not calibrated counts as failed. There are no other transitions.
namespace afm::haptics {

// Conditions found in one tick.
struct SafetyConditions {
  scene::FaultCode cut = scene::FaultCode::None;  // reason to cut: DeviceError, NotFinite, StopPressed, VelocityTrip
  scene::RendererLink renderer = scene::RendererLink::Absent;
  bool turn_on_edge = false;  // true: Turn-On pressed in this tick
  bool turn_on_held = false;
  bool interlock = false;  // true: lifted, free, still, no force requested
  bool dead_man = false;   // true: force only while Turn-On is held
  bool late = false;       // true: this tick is so late that the path of the hand is unknown
  bool outside = false;    // true: the hand is outside the workspace
  bool hot = false;        // true: motors too hot
  bool energy_exceeded = false;
};

struct SafetyState {
  scene::ServoState state = scene::ServoState::Disarmed;
  scene::FaultCode fault = scene::FaultCode::None;  // reason of the last fade or fault, until the next arming
  std::int64_t fade_ns = 0;                         // time from full force to none, while Fading

  bool armed() const noexcept { return scene::is_armed(state); }
};

inline constexpr std::int64_t kQuickFadeNs = 20'000'000;
inline constexpr std::int64_t kSlowFadeNs = 90'000'000;

// Call at the beginning of a tick. A fade in progress changes only for a more urgent reason, one with a shorter time.
SafetyState after_conditions(const SafetyState& before, const SafetyConditions& conditions) noexcept;

// Starts to remove the force within this time, for `fault` or, with None, in good order. Only in an armed state.
SafetyState begin_fade(const SafetyState& before, std::int64_t fade_ns, scene::FaultCode fault) noexcept;

// Call at the end of a tick: `gain` is the arming gain, `silent` is true if no force is commanded.
SafetyState after_output(const SafetyState& before, double gain, bool silent) noexcept;

}  // namespace afm::haptics
