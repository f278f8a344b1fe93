// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "haptics/servo_settings.h"

namespace afm::servo {

enum class ServoMode { Process, Thread };

inline constexpr double kServoRateHz = 1000.0;

// Settings of a servo and its device.
struct ServoChoice {
  ServoMode mode = ServoMode::Process;
  std::string haptic_device = "sim";  // value for parse_haptic_choice()
  haptics::ServoSettings settings{.rate_hz = kServoRateHz};
};

}  // namespace afm::servo
