// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "core/result.h"
#include "haptics/device_probe.h"

// What a person writes after --haptics, and the device that it stands for.
namespace afm::servo {

struct HapticChoice {
  haptics::DeviceChoice device = haptics::DeviceChoice::Simulated;
  std::string replay_file;  // not empty: a session whose hand is played, and no device
};

// "auto", "sim", "mouse", "hdapi", "haply", "gamepad" or "replay:FILE"; anything else is wrong usage. A mouse is for
// the servo the simulated hand, which the window moves.
core::Result<HapticChoice> parse_haptic_choice(std::string_view text);

// Opens it, where the environment says (probe_settings()). DeviceMissing: it is not there. BadInputFile: the session
// cannot be played. What was tried goes to the log, unless sim was asked for. `clock` outlives the device.
core::Result<haptics::OpenedDevice> open_haptic_device(const HapticChoice& choice, const core::Clock& clock);

// What the environment says of haptic drivers: TOUCHAFM_HD_LIBRARY, TOUCHAFM_HD_DEVICE and TOUCHAFM_HAPLY_PORT.
haptics::ProbeSettings probe_settings();

}  // namespace afm::servo
