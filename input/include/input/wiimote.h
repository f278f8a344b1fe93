// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "input/hid_report.h"

namespace afm::input {

// Report of a Wii Remote. 0x20: change of the extension; 0x21: data read from its memory; 0x30: buttons; 0x31: plus
// accelerometer; 0x33: plus four infrared dots; 0x35: with an extension instead; 0x37: two pairs of dots and an
// extension. Source: Linux' hid-wiimote-core.c; WiiBrew for the layout of the dots, of 0x20 and of 0x21.
struct WiimoteReport {
  std::uint16_t buttons = 0;                                 // bits, low byte first, without the accelerometer's bits
  std::optional<std::array<std::uint16_t, 3>> acceleration;  // raw, 10 bits, 512 at 0 g; x left, y to the hand, z up
  struct Dot {
    std::uint16_t x = 0;  // horizontal position, 0 to 1023
    std::uint16_t y = 0;  // vertical position, 0 to 767
  };
  std::array<std::optional<Dot>, 4> dots;
  std::optional<std::array<std::uint8_t, 6>> extension;  // first bytes, whose meaning depends on the type
  bool plug_changed = false;
  struct Memory {
    std::uint16_t address = 0;  // low 16 bits of the address
    std::array<std::uint8_t, 16> bytes{};
    std::size_t size = 0;  // number of bytes; 0: nothing to read
  };
  std::optional<Memory> memory;
};

std::optional<WiimoteReport> parse_wiimote(Bytes report);

// Gyroscope of a MotionPlus, or the one inside a Wii Remote Plus, in place of another extension.
struct MotionPlusReport {
  std::array<std::uint16_t, 3> rates{};  // raw rates, 14 bits, 8192 at rest; about the remote's left, back and up axes
  std::array<bool, 3> slow{};            // resolution of each rate; true: finer counts
};

// Parses the six bytes of an extension. Empty: not from a gyroscope, such as the bytes of an extension behind a
// MotionPlus. Source: Linux' hid-wiimote-modules.c; signs of the rotation from Dolphin's MotionPlus.cpp and
// IMUGyroscope.cpp.
std::optional<MotionPlusReport> parse_motion_plus(Bytes extension);

// A: Select, B: Grab, plus: Scale, Home: Home, minus: Recenter; the d-pad flies. Gravity gives the tilt, an active
// MotionPlus the rotation, and a sensor bar in the middle of the wall the direction straight ahead.
std::unique_ptr<HidDriver> wiimote_driver();

}  // namespace afm::input
