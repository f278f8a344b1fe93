// SPDX-License-Identifier: Apache-2.0
#include "haptics/safety.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>

#include "core/check.h"

namespace afm::haptics {

using scene::FaultCode;
using scene::ServoState;

namespace {

constexpr double kVelocityCutoffHz = 30.0;
constexpr double kPi = 3.14159265358979323846;

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Finite `v` shortened to `longest` where it is longer; direction kept. Scaled first, so that huge numbers do not
// overflow.
glm::dvec3 shortened(const glm::dvec3& v, double longest) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0.0) return v;
  const glm::dvec3 direction = v / largest;
  const double length = glm::length(direction);
  return largest * length <= longest ? v : direction * (longest / length);
}

double seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

}  // namespace

SafetyGovernor::SafetyGovernor(std::int64_t period_ns, double cap_n, double release_height_m, double slew_n_per_s)
    : period_ns_(period_ns), cap_n_(cap_n), release_height_m_(release_height_m), slew_n_per_s_(slew_n_per_s) {
  AFM_CHECK(period_ns > 0 && cap_n > 0 && std::isfinite(cap_n) && release_height_m > 0 && slew_n_per_s > 0);
}

bool SafetyGovernor::released() const noexcept {
  return (state_ == ServoState::Disarmed || state_ == ServoState::Fault) && command_n_ == glm::dvec3(0.0);
}

void SafetyGovernor::forget_motion() noexcept {
  started_ = false;
  turn_on_before_ = true;
  velocity_m_per_s_ = glm::dvec3(0.0);
  fast_ = false;
  guard_until_ns_ = damping_until_ns_ = std::numeric_limits<std::int64_t>::min();
}

SafetyGovernor::Output SafetyGovernor::step(const GovernorInput& input) noexcept {
  const std::int64_t elapsed_ns = started_ ? std::max<std::int64_t>(0, input.time_ns - time_ns_) : period_ns_;
  const bool turn_on_edge = input.turn_on && !turn_on_before_;
  turn_on_before_ = input.turn_on;
  time_ns_ = input.time_ns;

  if (!input.device_healthy) return cut(FaultCode::DeviceError);
  if (!finite(input.wanted_force_n) || !is_within_reach(input.hand_position_m) || !std::isfinite(input.hand_height_m)) {
    return cut(FaultCode::NotFinite);
  }
  if (!started_) position_m_ = input.hand_position_m;
  started_ = true;
  estimate_velocity(input.hand_position_m, seconds(elapsed_ns));

  // a late tick finds the hand elsewhere: the force glides to where the model now wants it
  const bool armed_before = state_ != ServoState::Disarmed && state_ != ServoState::Fault;
  if (elapsed_ns > 3 * period_ns_) guard_until_ns_ = input.time_ns + kGuardNs;
  if (elapsed_ns > kLateNs) begin_fade(kQuickFadeNs, FaultCode::LateTick);
  if (input.pulled_off) damping_until_ns_ = input.time_ns + kReleaseDampingNs;

  follow_renderer(input.renderer);
  advance_state(input, elapsed_ns, turn_on_edge);
  command_n_ = limited(input, elapsed_ns);
  if (too_fast(input.time_ns) && state_ != ServoState::Disarmed && state_ != ServoState::Fault) {
    return cut(FaultCode::VelocityTrip);
  }

  if (state_ == ServoState::Fading && gain_ == 0.0 && command_n_ == glm::dvec3(0.0)) state_ = ServoState::Disarmed;
  return {.command = ForceCommand(command_n_), .dropped = armed_before && state_ == ServoState::Disarmed};
}

void SafetyGovernor::begin_fade(std::int64_t duration_ns, FaultCode code) noexcept {
  if (state_ == ServoState::Fading) {
    // only a more urgent reason changes a fade under way
    if (duration_ns >= fade_duration_ns_) return;
  } else if (state_ != ServoState::Arming && state_ != ServoState::Running) {
    return;
  }
  state_ = ServoState::Fading;
  fade_begins_ = true;
  fade_duration_ns_ = duration_ns;
  fault_ = code;
}

SafetyGovernor::Output SafetyGovernor::cut(FaultCode code) noexcept {
  const bool dropped = state_ != ServoState::Fault;
  state_ = ServoState::Fault;
  fault_ = code;
  gain_ = 0.0;
  fast_ = false;
  damping_until_ns_ = time_ns_;
  command_n_ = glm::dvec3(0.0);
  return {.command = ForceCommand(command_n_), .dropped = dropped};
}

// A first-order low-pass on the differences of the position: for damping and the trip only, never for the force law.
void SafetyGovernor::estimate_velocity(const glm::dvec3& position_m, double elapsed_s) noexcept {
  if (elapsed_s > 0) {
    const double weight = -std::expm1(-2.0 * kPi * kVelocityCutoffHz * elapsed_s);
    velocity_m_per_s_ += weight * ((position_m - position_m_) / elapsed_s - velocity_m_per_s_);
  }
  position_m_ = position_m;
}

bool SafetyGovernor::may_arm(const GovernorInput& input) const noexcept {
  return input.renderer == RendererLink::Alive && input.phase == scene::ContactPhase::Free &&
         input.hand_height_m >= release_height_m_ + kArmingMarginM &&
         glm::length(input.wanted_force_n) < kArmingForceN && glm::length(velocity_m_per_s_) < kArmingSpeedMPerS;
}

void SafetyGovernor::follow_renderer(RendererLink link) noexcept {
  switch (link) {
    case RendererLink::Died:
      begin_fade(kQuickFadeNs, FaultCode::RendererDied);
      break;
    case RendererLink::Hung:
      begin_fade(kFadeNs, FaultCode::RendererHung);
      break;
    case RendererLink::Leaving:
      begin_fade(kFadeNs, FaultCode::None);
      break;
    case RendererLink::Absent:
    case RendererLink::Alive:
      break;
  }
}

void SafetyGovernor::advance_state(const GovernorInput& input, std::int64_t elapsed_ns, bool turn_on_edge) noexcept {
  switch (state_) {
    case ServoState::Disarmed:
      if (turn_on_edge && may_arm(input)) {
        state_ = ServoState::Arming;
        fault_ = FaultCode::None;
        gain_ = 0.0;
      }
      break;
    case ServoState::Arming:
      // a late tick does not shorten the ramp
      gain_ = std::min(1.0, gain_ + seconds(std::min(elapsed_ns, period_ns_)) / seconds(kArmingNs));
      if (gain_ >= 1.0) state_ = ServoState::Running;
      break;
    case ServoState::Fading:
      // the pause before the fade is not part of it
      gain_ = std::max(0.0, gain_ - seconds(fade_begins_ ? period_ns_ : elapsed_ns) / seconds(fade_duration_ns_));
      fade_begins_ = false;
      break;
    case ServoState::Fault:
      if (turn_on_edge) state_ = ServoState::Disarmed;
      break;
    case ServoState::Running:
      break;
  }
}

glm::dvec3 SafetyGovernor::limited(const GovernorInput& input, std::int64_t elapsed_ns) noexcept {
  glm::dvec3 target_n(0.0);
  if (gain_ > 0.0) {
    target_n = shortened(gain_ * input.wanted_force_n, cap_n_);
    if (input.time_ns < damping_until_ns_) target_n -= gain_ * kReleaseDampingNSPerM * velocity_m_per_s_;
    target_n = shortened(target_n, cap_n_);
  }
  // a fade has its own clock: it must be over in time
  const bool guarded = input.time_ns < guard_until_ns_ && state_ != ServoState::Fading;
  const double slew_n_per_s = guarded ? std::min(kGuardSlewNPerS, slew_n_per_s_) : slew_n_per_s_;
  const double largest_step_n = slew_n_per_s * seconds(std::min(elapsed_ns, period_ns_));
  return shortened(command_n_ + shortened(target_n - command_n_, largest_step_n), cap_n_);
}

bool SafetyGovernor::too_fast(std::int64_t now_ns) noexcept {
  const bool fast = glm::length(velocity_m_per_s_) > kTripSpeedMPerS;
  if (!fast || !fast_) fast_since_ns_ = now_ns;
  fast_ = fast;
  return fast && now_ns - fast_since_ns_ >= kTripNs;
}

}  // namespace afm::haptics
