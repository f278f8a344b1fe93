// SPDX-License-Identifier: Apache-2.0
#include "devices/hdapi_health.h"

#include "devices/hdapi_library.h"
#include "devices/hdapi_numbers.h"

namespace afm::haptics {

HdapiHealth health_after(std::uint32_t error_code) noexcept {
  switch (error_code) {
    case hdapi::kWarmMotors:
      return HdapiHealth::WarmMotors;
    case hdapi::kExceededForce:
      return HdapiHealth::ForceExceeded;
    case hdapi::kExceededForceImpulse:
      return HdapiHealth::ImpulseExceeded;
    case hdapi::kExceededVelocity:
      return HdapiHealth::VelocityExceeded;
    case hdapi::kCommunicationError:
    case hdapi::kCommunicationSetupError:
      return HdapiHealth::ConnectionLost;
    default:
      return HdapiHealth::DeviceFault;
  }
}

std::optional<std::int64_t> recovery_ns(HdapiHealth fault) noexcept {
  constexpr std::int64_t kShortNs = 200'000'000;  // time in which the driver switches its amplifiers off and on again
  constexpr std::int64_t kCoolingNs = 10'000'000'000;
  switch (fault) {
    case HdapiHealth::ForceExceeded:
    case HdapiHealth::ImpulseExceeded:
    case HdapiHealth::VelocityExceeded:
    case HdapiHealth::ImplausiblePosition:
      return kShortNs;
    case HdapiHealth::WarmMotors:
      return kCoolingNs;
    case HdapiHealth::Starting:
    case HdapiHealth::Ready:
    case HdapiHealth::Calibrating:
    case HdapiHealth::NeedsInkwell:
    case HdapiHealth::SchedulerStalled:
      return 0;
    case HdapiHealth::ConnectionLost:
    case HdapiHealth::DeviceFault:
      break;
  }
  return std::nullopt;
}

std::string_view describe(HdapiHealth health) noexcept {
  switch (health) {
    case HdapiHealth::Starting:
      return "starting";
    case HdapiHealth::Ready:
      return "ready; lift the pen and press Turn-On";
    case HdapiHealth::Calibrating:
      return "it is calibrating; wait";
    case HdapiHealth::NeedsInkwell:
      return "it is not calibrated; put the pen into the inkwell";
    case HdapiHealth::WarmMotors:
      return "its motors are too warm; let them cool for a few seconds";
    case HdapiHealth::ForceExceeded:
      return "the driver rejected a force as too large; press Turn-On again";
    case HdapiHealth::ImpulseExceeded:
      return "the driver rejected a force as too sudden; press Turn-On again";
    case HdapiHealth::VelocityExceeded:
      return "the pen was faster than the driver allows; press Turn-On again";
    case HdapiHealth::ImplausiblePosition:
      return "it reported an impossible position; hold the pen still, then press Turn-On again";
    case HdapiHealth::SchedulerStalled:
      return "its driver stopped calling; force output was switched off";
    case HdapiHealth::ConnectionLost:
      return "the connection was lost; check cable and power, then start again";
    case HdapiHealth::DeviceFault:
      return "it failed; switch it off and on, then start again";
  }
  return "unknown";
}

}  // namespace afm::haptics
