// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "input/hid_report.h"
#include "input/wand.h"

namespace afm::input {

// Mapping from the reports of any HID device to a wand, from a wand file. docs/adding-a-wand.md explains each key.
struct HidMapping {
  enum class Quantity { Push, Turn, Gyro, Acceleration };

  // Integer of `bits` bits, the lowest one at bit `bit` of byte `byte`. Byte 0 is the report's number if `report` is
  // not 0.
  struct Axis {
    Quantity quantity = Quantity::Push;
    int axis = 0;  // index of the axis, 0: x, 1: y, 2: z
    std::uint8_t report = 0;
    std::size_t byte = 0;
    unsigned bit = 0;   // lowest bit of the number, 0 to 7
    unsigned bits = 8;  // length of the number, 1 to 32 bits
    bool is_signed = false;
    double center = 0.0;
    double scale = 1.0;      // counts at full deflection, per degree per second, or per g; negative: reversed
    double dead_zone = 0.0;  // dead zone, 0 to 0.9 of full deflection
  };
  struct Button {
    WandButton button = WandButton::Select;
    std::uint8_t report = 0;
    std::size_t byte = 0;
    unsigned bit = 0;
  };

  std::string name;
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::vector<Axis> axes;
  std::vector<Button> buttons;
};

// Driver for a mapping. Without a gyroscope or accelerometer axis, the cap or stick steers the ray.
std::unique_ptr<HidDriver> mapped_driver(const HidMapping& mapping);

}  // namespace afm::input
