// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "input/hid_report.h"

namespace afm::input {

// Report of Sony's DualSense: id 1 with 64 bytes over USB, id 0x31 with 78 bytes and a CRC over Bluetooth. Source:
// Linux' hid-playstation.c.
struct DualSenseReport {
  std::array<std::uint8_t, 2> left_stick{};  // deflections, 128 in the middle; larger to the right and down
  std::array<std::uint8_t, 2> right_stick{};
  std::array<std::uint8_t, 2> triggers{};
  std::uint8_t sequence = 0;
  std::array<std::uint8_t, 3> buttons{};  // bits of the buttons; the low half of the first byte is the d-pad, 8 at rest
  std::array<std::int16_t, 3> gyro{};     // raw rotation rates, in the wand's axes
  std::array<std::int16_t, 3> acceleration{};
  std::uint32_t ticks = 0;  // time in units of 1/3 microsecond
};

std::optional<DualSenseReport> parse_dualsense(Bytes report);

// Calibration from feature report 5: physical = (raw - bias) * gain, in rad/s and in g.
struct DualSenseCalibration {
  std::array<double, 3> gyro_bias{};
  std::array<double, 3> gyro_gain{};
  std::array<double, 3> acceleration_bias{};
  std::array<double, 3> acceleration_gain{};
};

// Uses nominal numbers for every axis with an implausible calibration, and for an invalid report.
DualSenseCalibration parse_dualsense_calibration(Bytes report);

// Cross: Select, R2: Grab, L2: Scale, PS: Home, Options: Recenter; the left stick moves, the right one turns and lifts.
std::unique_ptr<HidDriver> dualsense_driver();

// CRC-32 (IEEE 802.3) of `seed` followed by the bytes, as at the end of Sony's Bluetooth reports.
std::uint32_t sony_crc32(std::uint8_t seed, Bytes bytes);

}  // namespace afm::input
