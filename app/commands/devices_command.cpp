// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "app/headset/headset_runtime.h"
#include "app/options/command.h"
#include "cluster/network.h"
#include "core/clock.h"
#include "core/printable.h"
#include "core/written_by.h"
#include "input/dtrack_source.h"
#include "input/hid_catalog.h"
#include "input/hid_source.h"
#include "input/tracker_report.h"
#include "input/wand_file.h"
#include "render/context.h"
#include "render/monitor.h"
#include "render/window.h"
#include "servo/haptic_choice.h"

namespace afm::app {

namespace {

struct Row {
  const char* kind;
  std::string device;
  bool usable = false;
  std::string detail;  // description, or the reason why it is unusable
};

// Time for listening to a tracker, which sends at least 60 frames a second.
constexpr std::int64_t kListenNs = 300'000'000;

// Names of the wands that need no wand file, without repetitions.
std::string known_wands(const std::vector<input::HidMapping>& mappings) {
  std::vector<std::string_view> names;
  const auto add = [&](std::string_view name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  };
  for (const input::HidModel& model : input::hid_models()) {
    if (model.make != nullptr) add(model.name);
  }
  for (const input::HidMapping& mapping : mappings) add(mapping.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

void look_for_hid_wands(const std::vector<input::HidMapping>& mappings, std::vector<Row>& rows) {
  const auto found = input::find_hid_wands(mappings);
  if (!found) {
    rows.push_back({"wand", "any", false, found.error().message});
    return;
  }
  for (const input::HidFinding& finding : *found) {
    rows.push_back({finding.is_wand ? "wand" : "hid", finding.name, finding.usable, finding.said});
  }
  const bool has_wand = std::any_of(found->begin(), found->end(), [](const auto& finding) { return finding.is_wand; });
  if (!has_wand)
    rows.push_back({"wand", "HID", false, "none is plugged in or visible; known: " + known_wands(mappings)});
}

Row listen_for_tracker(const input::DtrackSettings& settings) {
  const std::string name = fmt::format("dtrack {}:{}", settings.address, settings.port);
  const core::MonotonicClock clock;
  const auto source = input::DtrackSource::open(settings, clock);
  if (!source) return {"tracker", name, false, source.error().message};
  const std::int64_t end_ns = clock.now_ns() + kListenNs;
  while (clock.now_ns() < end_ns) (*source)->poll();
  const input::DtrackUpdate update = (*source)->newest();
  if (update.good_packets + update.bad_packets == 0) {
    return {"tracker", name, false, "no packet in 0.3 s: start the measurement, and send its output to this address"};
  }
  const std::string damaged = fmt::format(
      "{} malformed packets, {} frames lost, {} late or repeated in 0.3 s{}", update.bad_packets, update.lost_frames,
      update.old_packets, update.faults.count > 0 ? "; " + input::text_of(update.faults.first.front()) : "");
  if (update.good_packets == 0) return {"tracker", name, false, damaged};
  return {"tracker", name, true,
          fmt::format("{} frames, {} bodies, {} Flysticks; {}", update.good_packets, update.frame.body_count,
                      update.frame.flystick_count, damaged)};
}

void look_for_monitors(std::vector<Row>& rows) {
  const auto monitors = render::list_monitors();
  if (!monitors) {
    rows.push_back({"monitor", "any", false, monitors.error().message});
    return;
  }
  const auto display = render::check_display();
  for (std::size_t i = 0; i < monitors->size(); ++i) {
    const render::Monitor& monitor = monitors->at(i);
    const scene::PixelRect& rect = monitor.rect;
    if (!display) {
      rows.push_back({"monitor", monitor.name, false, display.error().message});
      continue;
    }
    rows.push_back({"monitor", monitor.name, true,
                    fmt::format("number {}, {} x {} pixels at {}, {}, {}", i + 1, rect.size_px.x, rect.size_px.y,
                                rect.offset_px.x, rect.offset_px.y,
                                monitor.rate_hz > 0 ? fmt::format("{:g} Hz", monitor.rate_hz) : "rate unknown")});
  }
  if (monitors->empty()) rows.push_back({"monitor", "any", false, "no monitor of this display is switched on"});
}

// Lists the network interfaces that can connect the machines of a wall.
void look_for_interfaces(std::vector<Row>& rows) {
  for (const cluster::NetworkInterface& one : cluster::network_interfaces()) {
    rows.push_back({"network", one.name, one.up,
                    fmt::format("{}, {}{}", one.address, one.multicast ? "multicast" : "no multicast",
                                one.up ? "" : ", no cable or switched off")});
  }
}

// Places to search for wands and trackers.
struct WandPlaces {
  std::vector<input::HidMapping> mappings;
  input::DtrackSettings tracker;
};

core::Result<WandPlaces> wand_places(const std::string& assets_dir, const std::string& wand_file) {
  WandPlaces places;
  auto mappings = input::load_mappings(assets_dir + "/wands");
  if (!mappings) return tl::unexpected(mappings.error());
  places.mappings = std::move(*mappings);
  if (wand_file.empty()) return places;
  const auto file = input::load_wand_file(wand_file);
  if (!file) return tl::unexpected(file.error());
  if (file->device) places.mappings.insert(places.mappings.begin(), *file->device);
  if (file->dtrack) places.tracker = *file->dtrack;
  return places;
}

std::vector<Row> look_for_devices(const WandPlaces& places) {
  std::vector<Row> rows;
  if (const auto devices = render::list_devices()) {
    for (const render::DeviceDescription& d : *devices) {
      rows.push_back({"vulkan", d.name, d.usable, d.usable ? d.kind + ", " + d.driver : d.reason});
    }
  } else {
    rows.push_back({"vulkan", "any", false, devices.error().message});
  }
  look_for_monitors(rows);
  if (const auto headset = find_headset()) {
    rows.push_back({"headset", headset->headset, true, text_of(*headset)});
  } else {
    rows.push_back({"headset", "OpenXR", false, headset.error().message});
  }
  for (const haptics::ProbeLine& line : haptics::probe_devices(servo::environment())) {
    rows.push_back({"haptic", line.subject, line.usable, line.said});
  }
  look_for_hid_wands(places.mappings, rows);
  rows.push_back(listen_for_tracker(places.tracker));
  rows.push_back({"wand", "simulated wand", true, "needs no device"});
  look_for_interfaces(rows);
  return rows;
}

core::Result<void> list(const std::string& assets_dir, const std::string& wand_file, bool json) {
  const auto places = wand_places(assets_dir, wand_file);
  if (!places) return tl::unexpected(places.error());
  std::vector<Row> rows = look_for_devices(*places);
  for (Row& r : rows) {
    r.device = core::printable_line(r.device);
    r.detail = core::printable_line(r.detail);
  }
  if (json) {
    nlohmann::json list = nlohmann::json::array();
    for (const Row& r : rows) {
      list.push_back({{"kind", r.kind}, {"device", r.device}, {"usable", r.usable}, {"detail", r.detail}});
      core::name_software(list.back());
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

void add_devices_command(OptionList& program, const CommandContext& context) {
  OptionList command = program.add_command("devices",
                                           "list the Vulkan devices, monitors, headset, haptic devices, wands, "
                                           "trackers and network interfaces, and explain why any of them is unusable");
  const auto json = std::make_shared<bool>(false);
  command.add_flag("--json", *json, "print the list as JSON");
  const auto wand_file = std::make_shared<std::string>();
  command.add_option("--wand-file", *wand_file, "wand file that describes your own device or your tracker's address")
      .type_name("FILE");
  command.footer(fmt::format(
      "example: touchafm devices\n"
      "Set {}=FILE to the driver library of a PHANTOM or Touch, and {}=NAME to the name of the device in its set-up.\n"
      "Set {}=FILE to Force Dimension's library, and {}=NUMBER to the serial number of the device.",
      haptics::kHdLibraryVariable, haptics::kHdDeviceVariable, haptics::kFdLibraryVariable,
      haptics::kFdDeviceVariable));
  command.when_chosen([&context, json, wand_file] { return list(context.assets_dir, *wand_file, *json); });
}

}  // namespace afm::app
