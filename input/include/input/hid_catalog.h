// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "input/hid_mapping.h"
#include "input/hid_report.h"

namespace afm::input {

// Device with a built-in protocol: a row of the catalog.
struct HidModel {
  std::uint16_t vendor;
  std::uint16_t product;
  std::string_view name;
  std::unique_ptr<HidDriver> (*make)();  // factory of the driver; null: known not to be a wand
};
std::span<const HidModel> hid_models();

// Identity that an HID device reports.
struct HidIdentity {
  std::uint16_t vendor = 0;
  std::uint16_t product = 0;
  std::uint16_t usage_page = 0;
  std::uint16_t usage = 0;
};

struct KnownHid {
  std::string name;
  std::function<std::unique_ptr<HidDriver>()> make;  // factory of the driver; empty: known not to be a wand
  bool only_stops = false;                           // true: a pedal that stops the force and does nothing else
};

// Description of a device; empty if it is unknown. A mapping takes precedence over the built-in entry.
std::optional<KnownHid> identify(const HidIdentity& device, std::span<const HidMapping> mappings);

}  // namespace afm::input
