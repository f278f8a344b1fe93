// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "input/hid_report.h"

namespace afm::input {

// A report of a Wii Remote: 0x20 what is plugged into it has changed, 0x21 what was read from its memory, 0x30 keys,
// 0x31 with accelerometer, 0x33 with four infrared dots too, 0x35 with an extension instead, 0x37 with two pairs of
// dots and an extension. Linux' hid-wiimote-core.c; the layout of the dots, of 0x20 and of 0x21 is WiiBrew's.
struct WiimoteReport {
  std::uint16_t buttons = 0;  // low byte first, without the bits that belong to the accelerometer
  std::optional<std::array<std::uint16_t, 3>> acceleration;  // 10 bits, 512 at 0 g; x left, y towards the hand, z up
  struct Dot {
    std::uint16_t x = 0;  // 0 to 1023
    std::uint16_t y = 0;  // 0 to 767
  };
  std::array<std::optional<Dot>, 4> dots;
  std::optional<std::array<std::uint8_t, 6>> extension;  // its first bytes; what they mean depends on what it is
  bool plug_changed = false;
  struct Memory {
    std::uint16_t address = 0;  // its low 16 bits
    std::array<std::uint8_t, 16> bytes{};
    std::size_t size = 0;  // of them; 0: there is nothing to read
  };
  std::optional<Memory> memory;
};

std::optional<WiimoteReport> parse_wiimote(Bytes report);

// The gyroscope of a MotionPlus, or of a Wii Remote Plus that has one inside, in place of another extension.
struct MotionPlusReport {
  std::array<std::uint16_t, 3> rates{};  // 14 bits, 8192 at rest; about the remote's left, its back and its upper side
  std::array<bool, 3> slow{};            // in the same order: finer counts
};

// Of the six bytes of an extension. Empty: not a gyroscope's, as those of what is plugged into a MotionPlus. Linux'
// hid-wiimote-modules.c; the senses of rotation are those of Dolphin's MotionPlus.cpp and IMUGyroscope.cpp.
std::optional<MotionPlusReport> parse_motion_plus(Bytes extension);

// A: Select, B: Grab, plus: Scale, Home: Home, minus: Recenter; the cross flies. Tilt comes from gravity, turning from
// a MotionPlus once it has answered, and what is straight ahead from a sensor bar in the middle of the wall.
std::unique_ptr<HidDriver> wiimote_driver();

}  // namespace afm::input
