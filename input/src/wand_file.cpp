// SPDX-License-Identifier: Apache-2.0
#include "input/wand_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "core/enumerators.h"
#include "scene/config/toml_file.h"
#include "scene/config/toml_table.h"

namespace afm::input {

namespace {

using scene::TomlTable;

constexpr std::int64_t kLargestByte = 1023;

// Number in the format of lsusb.
std::uint16_t read_hexadecimal(const TomlTable& table, std::string_view key) {
  const std::string digits = table.text(key);
  std::uint16_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    table.refuse(key, "must be up to four hexadecimal digits in quotes, such as \"256f\"");
  }
  return value;
}

// Position in a report; byte 0 of a numbered report is its number.
void read_place(const TomlTable& table, std::uint8_t& report, std::size_t& byte, unsigned& bit) {
  report = static_cast<std::uint8_t>(table.whole("report", 0, 255));
  byte = static_cast<std::size_t>(table.whole("byte", report == 0 ? 0 : 1, kLargestByte));
  bit = table.has("bit") ? static_cast<unsigned>(table.whole("bit", 0, 7)) : 0;
}

HidMapping::Axis read_axis(const TomlTable& table) {
  table.allow_only({"axis", "report", "byte", "bit", "bits", "signed", "center", "scale", "dead_zone"});
  using Quantity = HidMapping::Quantity;
  constexpr std::array<std::pair<std::string_view, Quantity>, 4> kQuantities{
      {{"push", Quantity::Push},
       {"turn", Quantity::Turn},
       {"gyro", Quantity::Gyro},
       {"acceleration", Quantity::Acceleration}}};
  static_assert(core::has_row_for_each(kQuantities, &std::pair<std::string_view, Quantity>::second));
  HidMapping::Axis axis;
  const std::string name = table.text("axis");
  bool known = false;
  for (const auto& [word, quantity] : kQuantities) {
    for (int i = 0; i < 3; ++i) {
      if (name != fmt::format("{}-{}", word, "xyz"[i])) continue;
      axis.quantity = quantity;
      axis.axis = i;
      known = true;
    }
  }
  if (!known) table.refuse("axis", "must be push, turn, gyro or acceleration with -x, -y or -z, such as \"push-x\"");
  read_place(table, axis.report, axis.byte, axis.bit);
  if (table.has("bits")) axis.bits = static_cast<unsigned>(table.whole("bits", 1, 32));
  if (table.has("signed")) axis.is_signed = table.flag("signed");
  constexpr double kMostCounts = 4294967295.0;
  if (table.has("center")) axis.center = table.number("center", -kMostCounts, kMostCounts);
  axis.scale = table.number("scale", -kMostCounts, kMostCounts);
  if (!(std::abs(axis.scale) >= 1e-3)) table.refuse("scale", "must not be zero");
  if (table.has("dead_zone")) axis.dead_zone = table.number("dead_zone", 0.0, 0.9);
  return axis;
}

HidMapping::Button read_button(const TomlTable& table) {
  table.allow_only({"button", "report", "byte", "bit"});
  constexpr std::array<std::pair<std::string_view, WandButton>, 6> kButtons{{{"select", WandButton::Select},
                                                                             {"grab", WandButton::Grab},
                                                                             {"scale", WandButton::Scale},
                                                                             {"home", WandButton::Home},
                                                                             {"recenter", WandButton::Recenter},
                                                                             {"stop", WandButton::Stop}}};
  const std::string name = table.text("button");
  const auto found = std::find_if(kButtons.begin(), kButtons.end(), [&](const auto& b) { return b.first == name; });
  if (found == kButtons.end()) table.refuse("button", "must be select, grab, scale, home, recenter or stop");
  HidMapping::Button button;
  button.button = found->second;
  read_place(table, button.report, button.byte, button.bit);
  return button;
}

HidMapping read_device(const TomlTable& root) {
  const TomlTable table = root.table("device", "[device]");
  table.allow_only({"name", "vendor", "product"});
  HidMapping mapping;
  mapping.name = table.text("name");
  mapping.vendor = read_hexadecimal(table, "vendor");
  mapping.product = read_hexadecimal(table, "product");
  if (root.has("axis")) {
    for (const TomlTable& axis : root.tables("axis")) mapping.axes.push_back(read_axis(axis));
  }
  if (root.has("button")) {
    for (const TomlTable& button : root.tables("button")) mapping.buttons.push_back(read_button(button));
  }
  const auto is_stop = [](const HidMapping::Button& button) { return button.button == WandButton::Stop; };
  const bool stops_alone =
      !mapping.buttons.empty() && std::all_of(mapping.buttons.begin(), mapping.buttons.end(), is_stop);
  if (mapping.axes.empty() && stops_alone) return mapping;  // complete for a pedal
  if (mapping.axes.empty()) table.refuse("name", "the device needs at least one [[axis]]");
  const bool selects = std::any_of(mapping.buttons.begin(), mapping.buttons.end(),
                                   [](const auto& button) { return button.button == WandButton::Select; });
  if (!selects) table.refuse("name", "the device needs a [[button]] with button = \"select\"");
  return mapping;
}

DtrackSettings read_dtrack(const TomlTable& table) {
  table.allow_only({"address", "port", "flystick", "head", "room_from_tracker"});
  DtrackSettings settings;
  if (table.has("address")) settings.address = table.text("address");
  if (table.has("port")) settings.port = static_cast<std::uint16_t>(table.whole("port", 1, 65535));
  if (table.has("flystick")) settings.flystick = static_cast<std::uint32_t>(table.whole("flystick", 0, 63));
  const TomlTable transform = table.table("room_from_tracker", "{ position = [x, y, z], orientation = [x, y, z, w] }");
  transform.allow_only({"position", "orientation"});
  settings.tracker_origin_m = transform.point("position");
  settings.room_from_tracker = transform.rotation("orientation");
  return settings;
}

WandFile read_wand_file(const toml::table& toml_root) {
  const TomlTable root(toml_root);
  root.allow_only({"hand", "dtrack", "device", "axis", "button"});
  WandFile file;
  if (root.has("hand")) file.hand_m = root.point("hand");
  if (root.has("dtrack")) {
    const TomlTable dtrack = root.table("dtrack", "[dtrack]");
    file.dtrack = read_dtrack(dtrack);
    if (dtrack.has("head")) file.head_body = static_cast<std::uint32_t>(dtrack.whole("head", 0, 63));
  }
  if (root.has("device")) {
    file.device = read_device(root);
  } else {
    for (const char* key : {"axis", "button"}) {
      if (root.has(key)) root.refuse(key, "belongs to a device; the file has no [device]");
    }
  }
  if (!file.hand_m && !file.dtrack && !file.device) {
    root.refuse("device", "is missing; the file needs hand, [dtrack] or [device]");
  }
  return file;
}

}  // namespace

core::Result<WandFile> load_wand_file(const std::string& path) {
  return scene::read_toml("wand file", path, read_wand_file);
}

core::Result<std::vector<HidMapping>> load_mappings(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".toml") paths.push_back(entry.path().string());
  }
  if (error) {
    return core::failure(core::ErrorCategory::BadInputFile,
                         fmt::format("folder of wand files {}: {}; check the path", folder, error.message()));
  }
  std::sort(paths.begin(), paths.end());
  std::vector<HidMapping> mappings;
  for (const std::string& path : paths) {
    auto file = load_wand_file(path);
    if (!file) return tl::unexpected(file.error());
    if (file->device) mappings.push_back(std::move(*file->device));
  }
  return mappings;
}

}  // namespace afm::input
