// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace afm::haptics {

// Health of a device driven through HDAPI. In every state except Ready its force output is off, and it reports to the
// servo that it is not healthy.
enum class HdapiHealth : std::uint32_t {
  Starting,  // no callback so far
  Ready,
  Calibrating,
  NeedsInkwell,  // the user must put the pen into the inkwell
  WarmMotors,
  ForceExceeded,
  ImpulseExceeded,
  VelocityExceeded,
  ImplausiblePosition,  // NaN, far outside the workspace, or a leap
  SchedulerStalled,     // no callback for HdapiDevice::kStallNs
  ConnectionLost,
  DeviceFault,  // device fault, and all errors without a name here
};

// State after an error of the library (not 0).
HdapiHealth health_after(std::uint32_t error_code) noexcept;

// Time without a new fault after which the device counts as healthy. Empty: only a restart of the servo clears it.
// Calibration and a stall have no such time; they end with their cause.
std::optional<std::int64_t> recovery_ns(HdapiHealth fault) noexcept;

// Fault and remedy, for the log: lower case, no full stop.
std::string_view describe(HdapiHealth health) noexcept;

}  // namespace afm::haptics
