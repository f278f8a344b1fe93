// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "input/hid_report.h"

namespace afm::input {

// A report of a Wii Remote: 0x30 keys, 0x31 with accelerometer, 0x33 with four infrared dots too, 0x37 with two pairs
// of dots and an extension. Linux' hid-wiimote-core.c; the layout of the dots is WiiBrew's.
struct WiimoteReport {
  std::uint16_t buttons = 0;  // low byte first, without the bits that belong to the accelerometer
  std::optional<std::array<std::uint16_t, 3>> acceleration;  // 10 bits, 512 at 0 g; x left, y towards the hand, z up
  struct Dot {
    std::uint16_t x = 0;  // 0 to 1023
    std::uint16_t y = 0;  // 0 to 767
  };
  std::array<std::optional<Dot>, 4> dots;
};

std::optional<WiimoteReport> parse_wiimote(Bytes report);

// A: Select, B: Grab, plus: Scale, Home: Home, minus: Recenter; the cross flies. It has no gyroscope: tilt comes from
// gravity, and what is straight ahead from a sensor bar in the middle of the wall.
std::unique_ptr<HidDriver> wiimote_driver();

}  // namespace afm::input
