// SPDX-License-Identifier: Apache-2.0
#include "haptics/safety.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/check.h"

namespace afm::haptics {

using physics::Phase;
using scene::FaultCode;
using scene::ServoState;

namespace {

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

bool is_number(const GovernorInput& input) {
  const glm::dvec3& force_n = input.wanted_force_n;
  return std::isfinite(force_n.x) && std::isfinite(force_n.y) && std::isfinite(force_n.z) &&
         is_within_reach(input.hand_position_m) && std::isfinite(input.hand_height_m) &&
         std::isfinite(input.law_energy.stored_j) && std::isfinite(input.law_energy.stiffness_n_per_m) &&
         std::isfinite(input.law_energy.oscillation_n) && std::isfinite(input.law_energy.given_j) &&
         std::isfinite(input.damping_n_s_per_m);
}

}  // namespace

SafetyLimits safety_limits(const DeviceSpec& device, std::int64_t period_ns, double release_height_m, bool dead_man) {
  return {.period_ns = period_ns,
          .force_cap_n = force_cap_n(device),
          .slew_n_per_s = usable_slew_n_per_s(device, SafetyGovernor::kSlewNPerS),
          .trip_speed_m_per_s = std::min(SafetyGovernor::kTripSpeedMPerS, kUsableLimitShare * device.max_speed_m_per_s),
          .continuous_force_n = device.max_continuous_force_n,
          .release_height_m = release_height_m,
          .workspace_min_m = device.workspace_min_m - device.contact_point_m,
          .workspace_max_m = device.workspace_max_m - device.contact_point_m,
          .dead_man = dead_man};
}

SafetyGovernor::SafetyGovernor(const SafetyLimits& limits)
    : period_ns_(limits.period_ns),
      release_height_m_(limits.release_height_m),
      dead_man_(limits.dead_man),
      output_(limits.force_cap_n, limits.slew_n_per_s, WorkspaceStop(limits.workspace_min_m, limits.workspace_max_m)),
      motion_(limits.trip_speed_m_per_s),
      motors_(limits.continuous_force_n, limits.force_cap_n),
      slew_n_per_s_(limits.slew_n_per_s) {
  AFM_CHECK(limits.period_ns > 0 && limits.release_height_m > 0);
}

bool SafetyGovernor::released() const noexcept { return !state_.armed() && output_.command_n() == glm::dvec3(0.0); }

void SafetyGovernor::forget_motion() noexcept {
  started_ = false;
  turn_on_before_ = true;
  motion_.forget();
  guard_until_ns_ = damping_until_ns_ = std::numeric_limits<std::int64_t>::min();
}

SafetyGovernor::Output SafetyGovernor::step(const GovernorInput& input) noexcept {
  const std::int64_t elapsed_ns = started_ ? std::max<std::int64_t>(0, input.time_ns - time_ns_) : period_ns_;
  started_ = true;
  time_ns_ = input.time_ns;
  const bool armed_before = state_.armed();
  const bool in_fault_before = state_.state == ServoState::Fault;

  state_ = after_conditions(state_, evaluate(input, elapsed_ns));
  turn_on_before_ = input.turn_on;
  if (state_.state == ServoState::Fault) {
    output_.cut();
    gain_ = 0.0;
  } else {
    advance_gain(elapsed_ns);
    if (const FaultCode fault = limit_force(input, elapsed_ns); fault != FaultCode::None) {
      state_ = after_conditions(state_, {.cut = fault});
      gain_ = 0.0;
    }
  }
  state_ = after_output(state_, gain_, output_.command_n() == glm::dvec3(0.0));
  remember(input);

  const bool in_fault = state_.state == ServoState::Fault;
  const bool dropped = in_fault ? !in_fault_before : armed_before && !state_.armed();
  return {.command = ForceCommand(output_.command_n()), .dropped = dropped};
}

SafetyConditions SafetyGovernor::evaluate(const GovernorInput& input, std::int64_t elapsed_ns) noexcept {
  SafetyConditions conditions{.renderer = input.renderer,
                              .turn_on_edge = input.turn_on && !turn_on_before_,
                              .turn_on_held = input.turn_on,
                              .dead_man = dead_man_};
  motors_.update(glm::length(output_.command_n()), seconds(elapsed_ns), input.motor_heat);
  if (!input.device_healthy || !is_number(input)) {
    conditions.cut = input.device_healthy ? FaultCode::NotFinite : FaultCode::DeviceError;
    motion_.forget();
    return conditions;
  }
  motion_.move(input.hand_position_m, elapsed_ns);
  observe_energy(input);

  // a late tick finds the hand elsewhere: the force moves gradually to the model's new value
  if (elapsed_ns > 3 * period_ns_) guard_until_ns_ = input.time_ns + kGuardNs;
  if (input.pulled_off) damping_until_ns_ = input.time_ns + kReleaseDampingNs;

  if (motion_.too_fast()) conditions.cut = FaultCode::VelocityTrip;
  if (input.renderer == RendererLink::Stopped) conditions.cut = FaultCode::StopPressed;
  conditions.interlock = high_and_free(input) && glm::length(input.wanted_force_n) < kArmingForceN &&
                         glm::length(motion_.velocity_m_per_s()) < kArmingSpeedMPerS;
  conditions.late = elapsed_ns > kLateNs;
  conditions.outside = output_.stop().is_outside(input.hand_position_m);
  conditions.hot = motors_.heat() >= MotorThermalModel::kHot;
  conditions.energy_exceeded = observer_.exceeded();
  return conditions;
}

// Energy exchanged between the hand and its device since the previous tick.
void SafetyGovernor::observe_energy(const GovernorInput& input) noexcept {
  const bool fresh = !input.led && high_and_free(input) && input.time_ns >= damping_until_ns_;
  if (!state_.armed() || fresh) observer_.reset();
  if (!previous_.valid || (input.phase == Phase::WaitForLift && !input.led) || input.sample_moved) return;
  if (input.led != previous_.led) return;
  if (input.law_energy.is_dynamic && input.phase != previous_.phase) return;
  const double stop_j = output_.stop().stored_j(input.hand_position_m);
  const bool in_stop = stop_j > 0.0 || previous_.stop_stored_j > 0.0;
  observer_.integrate({.moved_m = motion_.moved_m(),
                       .wanted_n = output_.wanted_n(),
                       .commanded_n = output_.command_n(),
                       .stored_rise_j = previous_.law_gain * (input.law_energy.stored_j - input.law_energy.given_j -
                                                              previous_.law.stored_j) +
                                        previous_.stop_gain * (stop_j - previous_.stop_stored_j),
                       .stiffness_n_per_m = previous_.law_gain * previous_.law.stiffness_n_per_m +
                                            (in_stop ? previous_.stop_gain * WorkspaceStop::kStiffnessNPerM : 0.0),
                       .oscillation_n = previous_.law_gain * previous_.law.oscillation_n});
}

bool SafetyGovernor::high_and_free(const GovernorInput& input) const noexcept {
  return input.phase == Phase::Free && input.hand_height_m >= release_height_m_ + kArmingMarginM;
}

void SafetyGovernor::advance_gain(std::int64_t elapsed_ns) noexcept {
  switch (state_.state) {
    case ServoState::Arming:
      // a late tick does not shorten the ramp
      gain_ = std::min(1.0, gain_ + seconds(std::min(elapsed_ns, period_ns_)) / seconds(kArmingNs));
      break;
    case ServoState::Fading:
      // the pause before the fade is not part of it
      gain_ = std::max(0.0, gain_ - seconds(fade_under_way_ ? elapsed_ns : period_ns_) / seconds(state_.fade_ns));
      break;
    case ServoState::Disarmed:
    case ServoState::Fault:
      gain_ = 0.0;
      break;
    case ServoState::Running:
      break;
  }
  fade_under_way_ = state_.state == ServoState::Fading;
}

FaultCode SafetyGovernor::limit_force(const GovernorInput& input, std::int64_t elapsed_ns) noexcept {
  const double period_s = seconds(std::min(elapsed_ns, period_ns_));
  observer_damping_ =
      state_.armed() ? observer_.damping_n_s_per_m(motion_.velocity_m_per_s(), seconds(period_ns_)) : 0.0;
  const double release_damping = input.time_ns < damping_until_ns_ ? kReleaseDampingNSPerM : 0.0;
  // a fade has its own timing and must end in time
  const bool guarded = input.time_ns < guard_until_ns_ && state_.state != ServoState::Fading;
  slew_n_per_s_ = guarded ? std::min(kGuardSlewNPerS, output_.slew_n_per_s()) : output_.slew_n_per_s();
  return output_.step({.law_force_n = input.wanted_force_n,
                       .position_m = input.hand_position_m,
                       .velocity_m_per_s = motion_.velocity_m_per_s(),
                       .arm_gain = gain_,
                       .thermal_gain = motors_.gain(),
                       .damping_n_s_per_m = std::max({observer_damping_, release_damping, input.damping_n_s_per_m}),
                       .slew_n_per_s = slew_n_per_s_,
                       .elapsed_s = period_s,
                       .too_fast = motion_.too_fast() && state_.armed()});
}

void SafetyGovernor::remember(const GovernorInput& input) noexcept {
  previous_ = {.valid = state_.armed() && (input.phase != Phase::WaitForLift || input.led),
               .law_gain = gain_ * motors_.gain(),
               .stop_gain = gain_,
               .phase = input.phase,
               .led = input.led,
               .law = input.law_energy,
               .stop_stored_j = output_.stop().stored_j(input.hand_position_m)};
}

}  // namespace afm::haptics
