// SPDX-License-Identifier: Apache-2.0
#include "forcedimension/dhd_health.h"

#include "forcedimension/dhd_library.h"

namespace afm::haptics {

DhdHealth dhd_health_after(int error) noexcept {
  switch (error) {
    case dhd::kCommunicationError:
    case dhd::kNoDriver:
    case dhd::kNoDevice:
    case dhd::kTimeout:
      return DhdHealth::ConnectionLost;
    case dhd::kGeometry:
      return DhdHealth::ImplausiblePosition;
    case dhd::kNotReady:
      return DhdHealth::ForceRefused;
    default:
      return DhdHealth::DeviceFault;
  }
}

DhdHealth dhd_health_after_cause(int force_off_cause) noexcept {
  switch (force_off_cause) {
    case dhd::kOffByButton:
      return DhdHealth::ForceButtonOff;
    case dhd::kOffByVelocity:
      return DhdHealth::VelocityExceeded;
    case dhd::kOffByWatchdog:
      return DhdHealth::WatchdogExpired;
    case dhd::kOffByCable:
      return DhdHealth::ConnectionLost;
    case dhd::kOffByDeadMan:
      return DhdHealth::DeadManReleased;
    default:
      return DhdHealth::ForceRefused;
  }
}

std::optional<std::int64_t> dhd_recovery_ns(DhdHealth fault) noexcept {
  constexpr std::int64_t kShortNs = 200'000'000;
  switch (fault) {
    case DhdHealth::VelocityExceeded:
    case DhdHealth::WatchdogExpired:
    case DhdHealth::ForceRefused:
    case DhdHealth::ButtonFailed:
    case DhdHealth::ImplausiblePosition:
      return kShortNs;
    case DhdHealth::Starting:
    case DhdHealth::Ready:
    case DhdHealth::NeedsCalibration:
    case DhdHealth::NoPower:
    case DhdHealth::ForceButtonOff:
    case DhdHealth::DeadManReleased:
    case DhdHealth::Stalled:
      return 0;
    case DhdHealth::ConnectionLost:
    case DhdHealth::DeviceFault:
      break;
  }
  return std::nullopt;
}

std::string_view describe(DhdHealth health) noexcept {
  switch (health) {
    case DhdHealth::Starting:
      return "starting";
    case DhdHealth::Ready:
      return "ready; raise the handle and press Turn-On";
    case DhdHealth::NeedsCalibration:
      return "it is not calibrated; put its calibration pin into the pit until its light stops blinking (Falcon: pull "
             "the grip out and push it in)";
    case DhdHealth::NoPower:
      return "it has no power; switch it on";
    case DhdHealth::ForceButtonOff:
      return "its force button is off; press it";
    case DhdHealth::DeadManReleased:
      return "its own dead-man switch is open; hold it, then press the force button";
    case DhdHealth::VelocityExceeded:
      return "the handle was faster than the device allows; press Turn-On again";
    case DhdHealth::WatchdogExpired:
      return "the device had no new force for 20 ms and switched it off; close other programs, then press Turn-On "
             "again";
    case DhdHealth::ForceRefused:
      return "the device refused a force; press its force button, then Turn-On";
    case DhdHealth::ButtonFailed:
      return "its button cannot be read; press Turn-On again";
    case DhdHealth::ImplausiblePosition:
      return "it reported an impossible position; hold the handle still, then press Turn-On again";
    case DhdHealth::Stalled:
      return "its driver stopped answering; the force was switched off";
    case DhdHealth::ConnectionLost:
      return "the connection was lost; check cable and power, then start again";
    case DhdHealth::DeviceFault:
      return "it failed; switch it off and on, then start again";
  }
  return "unknown";
}

}  // namespace afm::haptics
