// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "input/hid_report.h"

namespace afm::input {

// Report 0x30 of Nintendo's Joy-Cons and Pro controller: 49 bytes every 15 ms with three readings of the motion sensor.
// Source: Linux' hid-nintendo.c.
struct JoyConReport {
  std::array<std::uint8_t, 3> buttons{};                 // bytes of the buttons: right, shared, left
  std::array<std::array<std::uint16_t, 2>, 2> sticks{};  // left and right stick; 12 bits, about 2048 in the middle
  struct Motion {
    std::array<std::int16_t, 3> acceleration{};  // raw, 4096 for 1 g; x forward, y left, z up on a left Joy-Con
    std::array<std::int16_t, 3> gyro{};          // raw, 14.247 for 1 degree per second
  };
  std::array<Motion, 3> motion{};  // readings, the oldest first
};

std::optional<JoyConReport> parse_joycon(Bytes report);

enum class JoyConSide { Left, Right, Pro };

// Right and Pro: A selects, ZR grabs, R scales, Home, plus recentres. Left: the right arrow selects, ZL grabs, L
// scales, Capture is Home, minus recentres. The stick moves.
std::unique_ptr<HidDriver> joycon_driver(JoyConSide side);

}  // namespace afm::input
