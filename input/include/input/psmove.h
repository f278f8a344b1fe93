// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "input/hid_report.h"

namespace afm::input {

enum class PsMoveModel { Zcm1, Zcm2 };

// Report 1 of Sony's PS Move: two readings of the motion sensor, raw; x to the right, y along the ball, z out of the
// buttons. Source: Monado's psmv_driver.c.
struct PsMoveReport {
  std::array<std::uint8_t, 4> buttons{};
  std::uint8_t trigger = 0;
  std::array<std::array<std::int32_t, 3>, 2> acceleration{};
  std::array<std::array<std::int32_t, 3>, 2> gyro{};
};

std::optional<PsMoveReport> parse_psmove(PsMoveModel model, Bytes report);

// Calibration stored in the device: physical = (raw - bias) * gain, in rad/s and in g.
struct PsMoveCalibration {
  std::array<double, 3> gyro_gain{};
  std::array<double, 3> acceleration_bias{};
  std::array<double, 3> acceleration_gain{};
};

// Feature report 0x10, requested three times (ZCM1) or twice (ZCM2), in any order. Uses nominal numbers for implausible
// values. Layout as in psmoveapi.
PsMoveCalibration parse_psmove_calibration(PsMoveModel model, std::span<const std::vector<std::uint8_t>> reports);

// Move: Select, trigger: Grab, cross: Scale, PS: Home, Start: Recenter.
std::unique_ptr<HidDriver> psmove_driver(PsMoveModel model);

}  // namespace afm::input
