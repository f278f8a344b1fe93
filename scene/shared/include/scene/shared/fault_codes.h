// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "core/enumerators.h"

namespace afm::scene {

// Reason why the servo removed the force. No servo ever used 7; the numbers are stable.
enum class FaultCode : std::uint32_t {
  None = 0,
  RendererDied = 1,
  RendererHung = 2,
  NotFinite = 3,
  LateTick = 4,
  VelocityTrip = 5,
  DeviceError = 6,
  ServoSilent = 7,  // reported by the renderer, in place of the servo
  DeadManReleased = 8,
  MotorsHot = 9,
  EnergyExceeded = 10,
  OutOfWorkspace = 11,
  StopPressed = 12,
  PictureUnseen = 13,
};

struct FaultText {
  FaultCode code;
  const char* key;     // key in assets/guidance; that of None introduces the reason for a missing force
  const char* reason;  // English text for the log
};

inline constexpr std::array kFaultTexts{
    FaultText{FaultCode::None, "force-off", "no fault"},
    FaultText{FaultCode::RendererDied, "renderer-died", "the renderer died"},
    FaultText{FaultCode::RendererHung, "renderer-hung", "the renderer gave no frame for 250 ms"},
    FaultText{FaultCode::NotFinite, "not-finite", "a position or force was not finite"},
    FaultText{FaultCode::LateTick, "late-tick", "a servo tick came more than 20 ms late"},
    FaultText{FaultCode::VelocityTrip, "velocity-trip", "the hand was faster than is safe"},
    FaultText{FaultCode::DeviceError, "device-error", "the haptic device failed"},
    FaultText{FaultCode::ServoSilent, "servo-silent", "the servo is silent: let go of the device"},
    FaultText{FaultCode::DeadManReleased, "dead-man-released", "the Turn-On button was let go"},
    FaultText{FaultCode::MotorsHot, "motors-hot", "the device's motors are hot"},
    FaultText{FaultCode::EnergyExceeded, "energy-exceeded", "the hand was given more energy than the model holds"},
    FaultText{FaultCode::OutOfWorkspace, "out-of-workspace", "the hand left the device's workspace"},
    FaultText{FaultCode::StopPressed, "stop-pressed", "Stop was pressed"},
    FaultText{FaultCode::PictureUnseen, "picture-unseen", "nobody sees the picture"}};
static_assert(core::has_row_for_each(kFaultTexts, &FaultText::code));

// "the renderer gave no frame for 250 ms"
constexpr const char* reason(FaultCode code) { return kFaultTexts[core::index_of(code)].reason; }

}  // namespace afm::scene
