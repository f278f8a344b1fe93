// SPDX-License-Identifier: Apache-2.0
#include "haptics/safety_states.h"

#include <optional>

namespace afm::haptics {

using scene::FaultCode;
using scene::RendererLink;
using scene::ServoState;

namespace {

struct Reason {
  std::int64_t fade_ns;
  FaultCode fault;
};

// Most urgent of the reasons to remove the force.
std::optional<Reason> reason_to_fade(const SafetyConditions& conditions) {
  if (conditions.late) return Reason{kQuickFadeNs, FaultCode::LateTick};
  if (conditions.energy_exceeded) return Reason{kQuickFadeNs, FaultCode::EnergyExceeded};
  if (conditions.outside) return Reason{kQuickFadeNs, FaultCode::OutOfWorkspace};
  if (conditions.renderer == RendererLink::Died) return Reason{kQuickFadeNs, FaultCode::RendererDied};
  if (conditions.renderer == RendererLink::Unseen) return Reason{kQuickFadeNs, FaultCode::PictureUnseen};
  if (conditions.dead_man && !conditions.turn_on_held) return Reason{kQuickFadeNs, FaultCode::DeadManReleased};
  if (conditions.hot) return Reason{kSlowFadeNs, FaultCode::MotorsHot};
  if (conditions.renderer == RendererLink::Hung) return Reason{kSlowFadeNs, FaultCode::RendererHung};
  if (conditions.renderer == RendererLink::Leaving) return Reason{kSlowFadeNs, FaultCode::None};
  return std::nullopt;
}

}  // namespace

SafetyState begin_fade(const SafetyState& before, std::int64_t fade_ns, FaultCode fault) noexcept {
  if (!before.armed()) return before;
  if (before.state == ServoState::Fading && fade_ns >= before.fade_ns) return before;
  return {ServoState::Fading, fault, fade_ns};
}

SafetyState after_conditions(const SafetyState& before, const SafetyConditions& conditions) noexcept {
  // a hand that feels no force may move at any speed
  const bool cut = conditions.cut != FaultCode::None && (before.armed() || conditions.cut != FaultCode::VelocityTrip);
  if (cut) return {ServoState::Fault, conditions.cut, 0};

  const auto reason = reason_to_fade(conditions);
  switch (before.state) {
    case ServoState::Disarmed:
      if (conditions.turn_on_edge && conditions.interlock && conditions.renderer == RendererLink::Alive &&
          conditions.cut == FaultCode::None && !reason) {
        return {ServoState::Arming, FaultCode::None, 0};
      }
      return before;
    case ServoState::Fault:
      if (conditions.turn_on_edge) return {ServoState::Disarmed, before.fault, 0};
      return before;
    case ServoState::Arming:
    case ServoState::Running:
    case ServoState::Fading:
      return reason ? begin_fade(before, reason->fade_ns, reason->fault) : before;
  }
  return before;
}

SafetyState after_output(const SafetyState& before, double gain, bool silent) noexcept {
  if (before.state == ServoState::Arming && gain >= 1.0) return {ServoState::Running, before.fault, 0};
  if (before.state == ServoState::Fading && gain <= 0.0 && silent) return {ServoState::Disarmed, before.fault, 0};
  return before;
}

}  // namespace afm::haptics
