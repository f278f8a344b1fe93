// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace afm::haptics {

// Health of a device driven through DHD. In every state except Ready its force is off and its brakes are on, and it
// reports to the servo that it is not healthy.
enum class DhdHealth : std::uint32_t {
  Starting,  // no position so far
  Ready,
  NeedsCalibration,  // the user must move the end-effector to its rest
  NoPower,
  ForceButtonOff,  // force switched off at the device
  DeadManReleased,
  VelocityExceeded,
  WatchdogExpired,  // the device received no force for DhdDevice::kWatchdogNs
  ForceRefused,     // the device left force mode, or accepts no force, without a reason
  ButtonFailed,
  ImplausiblePosition,  // NaN, far outside the workspace, or a leap
  Stalled,              // no new position for DhdDevice::kStallNs
  ConnectionLost,
  DeviceFault,  // device fault, and all errors without a name here
};

// State after an error of the library.
DhdHealth dhd_health_after(int error) noexcept;

// State after the device itself left force mode.
DhdHealth dhd_health_after_cause(int force_off_cause) noexcept;

// Time without a new fault after which the device counts as healthy. Empty: only a restart of the servo clears it.
// States that end with their cause have no such time.
std::optional<std::int64_t> dhd_recovery_ns(DhdHealth fault) noexcept;

// Fault and remedy, for the log: lower case, no full stop.
std::string_view describe(DhdHealth health) noexcept;

}  // namespace afm::haptics
