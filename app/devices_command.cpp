// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command.h"
#include "app/haptic_choice.h"
#include "render/context.h"

namespace afm::app {

namespace {

struct Row {
  const char* kind;
  std::string device;
  bool usable = false;
  std::string detail;  // what it is, or why it cannot be used
};

std::vector<Row> look_for_devices() {
  std::vector<Row> rows;
  if (const auto devices = render::list_devices()) {
    for (const render::DeviceDescription& d : *devices) {
      rows.push_back({"vulkan", d.name, d.usable, d.usable ? d.kind + ", " + d.driver : d.reason});
    }
  } else {
    rows.push_back({"vulkan", "any", false, devices.error().message});
  }
  for (const haptics::ProbeLine& line : haptics::probe_devices(probe_settings())) {
    rows.push_back({"haptic", line.subject, line.usable, line.said});
  }
  rows.push_back({"wand", "simulated wand", true, "needs no device"});
  return rows;
}

core::Result<void> list(bool json) {
  const std::vector<Row> rows = look_for_devices();
  if (json) {
    nlohmann::json list = nlohmann::json::array();
    for (const Row& r : rows) {
      list.push_back({{"kind", r.kind}, {"device", r.device}, {"usable", r.usable}, {"detail", r.detail}});
    }
    std::puts(list.dump().c_str());
    return {};
  }
  std::size_t width = 0;
  for (const Row& r : rows) width = std::max(width, r.device.size());
  for (const Row& r : rows) {
    fmt::print("{:<7} {:<{}}  {:<10}  {}\n", r.kind, r.device, width, r.usable ? "usable" : "not usable", r.detail);
  }
  return {};
}

}  // namespace

void add_devices_command(CLI::App& app, CommandContext& context) {
  CLI::App* command =
      app.add_subcommand("devices", "list the Vulkan devices, haptic devices and wands: what was tried, and why not");
  const auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print the list as JSON");
  command->footer(
      fmt::format("example: touchafm devices\n{}=FILE names the library of a PHANTOM's or Touch's driver, "
                  "{}=NAME the device in its set-up.",
                  haptics::kHdLibraryVariable, haptics::kHdDeviceVariable));
  command->callback([&context, json] { context.chosen = [json] { return list(*json); }; });
}

}  // namespace afm::app
