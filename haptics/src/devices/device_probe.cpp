// SPDX-License-Identifier: Apache-2.0
#include "haptics/device_probe.h"
#include "devices/haply_device.h"

#include <fmt/core.h>

#include <optional>
#include <utility>

#include "devices/gamepad_device.h"
#include "devices/hdapi_device.h"
#include "devices/hdapi_library.h"
#include "devices/sdl_library.h"
#include "haptics/simulated_device.h"

namespace afm::haptics {

namespace {

// The dynamic linker repeats the name that it was given.
std::string without_name(const LibraryAttempt& attempt) {
  const std::string prefix = attempt.name + ": ";
  return attempt.refusal.starts_with(prefix) ? attempt.refusal.substr(prefix.size()) : attempt.refusal;
}

// The library, or nothing; what was tried is added to `lines`.
std::optional<HdapiFunctions> find_library(const ProbeSettings& settings, std::vector<ProbeLine>& lines) {
  const HdapiSearch search = load_hdapi(settings.hd_library);
  for (const LibraryAttempt& attempt : search.attempts) {
    const bool taken = attempt.refusal.empty();
    lines.push_back({"hdapi library " + attempt.name, taken, taken ? "loaded" : without_name(attempt)});
  }
  return search.functions;
}

std::string joined(const std::vector<ProbeLine>& lines) {
  std::string text;
  for (const ProbeLine& line : lines)
    text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", line.subject, line.said);
  return text;
}

core::Result<std::unique_ptr<HapticDevice>> open_hdapi(const ProbeSettings& settings, const core::Clock& clock,
                                                       std::vector<ProbeLine>& lines) {
  const auto functions = find_library(settings, lines);
  if (!functions) {
    return core::failure(
        core::ErrorCategory::DeviceMissing,
        fmt::format("no hdapi device: {}; install the device's driver, or set {} to the path of its library",
                    joined(lines), kHdLibraryVariable));
  }
  auto device = HdapiDevice::open(*functions, clock, settings.hd_device);
  if (!device) {
    lines.push_back({kHdapiDevice, false, device.error().message});
    return tl::unexpected(device.error());
  }
  lines.push_back({kHdapiDevice, true, (*device)->spec().name});
  return std::unique_ptr<HapticDevice>(std::move(*device));
}

core::Result<std::unique_ptr<HapticDevice>> open_haply(const ProbeSettings& settings, const core::Clock& clock,
                                                       std::vector<ProbeLine>& lines) {
  auto device = HaplyDevice::open(clock, settings.haply_port);
  if (!device) {
    lines.push_back({kHaplyDevice, false, device.error().message});
    return tl::unexpected(device.error());
  }
  lines.push_back({kHaplyDevice, true, (*device)->spec().name});
  return std::unique_ptr<HapticDevice>(std::move(*device));
}

core::Result<std::unique_ptr<HapticDevice>> open_gamepad(GamepadDevice::Wanted wanted, const core::Clock& clock,
                                                         std::vector<ProbeLine>& lines) {
  const auto refused = [&](const core::Error& error) {
    lines.push_back({kGamepad, false, error.message});
    return core::failure(error.category, "no gamepad: " + error.message);
  };
  const auto sdl = load_sdl();
  if (!sdl) return refused(sdl.error());
  auto device = GamepadDevice::open(*sdl, clock, wanted);
  if (!device) return refused(device.error());
  lines.push_back({kGamepad, true, (*device)->spec().name});
  return std::unique_ptr<HapticDevice>(std::move(*device));
}

void look_for_gamepads(std::vector<ProbeLine>& lines) {
  const auto sdl = load_sdl();
  const auto found = sdl ? GamepadDevice::list(*sdl) : tl::unexpected(sdl.error());
  if (!found) {
    lines.push_back({kGamepad, false, found.error().message});
    return;
  }
  if (found->empty()) lines.push_back({kGamepad, false, GamepadDevice::kNone});
  for (const GamepadDevice::Facts& pad : *found) {
    const char* shows = pad.force_feedback ? "force feedback"
                        : pad.rumble       ? "rumble"
                                           : "moves the hand, shows no force";
    lines.push_back({kGamepad, true, fmt::format("{}: {}", pad.name, shows)});
  }
}

}  // namespace

core::Result<OpenedDevice> open_device(DeviceChoice choice, const ProbeSettings& settings, const core::Clock& clock) {
  OpenedDevice opened;
  const auto open = [&](DeviceChoice kind) {
    if (kind == DeviceChoice::Hdapi) return open_hdapi(settings, clock, opened.lines);
    if (kind == DeviceChoice::Haply) return open_haply(settings, clock, opened.lines);
    using Wanted = GamepadDevice::Wanted;
    // a gamepad that lies on the desk must not take the hand away from the mouse
    return open_gamepad(choice == DeviceChoice::Auto ? Wanted::ForceFeedback : Wanted::Any, clock, opened.lines);
  };
  for (const DeviceChoice kind : {DeviceChoice::Hdapi, DeviceChoice::Haply, DeviceChoice::Gamepad}) {
    if (choice != DeviceChoice::Auto && choice != kind) continue;
    auto device = open(kind);
    if (device) {
      opened.device = std::move(*device);
      return opened;
    }
    if (choice == kind) return tl::unexpected(device.error());
  }
  opened.device = std::make_unique<SimulatedDevice>();
  opened.lines.push_back({kSimulatedHand, true, "needs no device"});
  return opened;
}

std::vector<ProbeLine> probe_devices(const ProbeSettings& settings) {
  std::vector<ProbeLine> lines;
  if (const auto functions = find_library(settings, lines)) {
    const auto spec = HdapiDevice::query(*functions, settings.hd_device);
    lines.push_back({kHdapiDevice, spec.has_value(),
                     spec ? fmt::format("{}: {:.2g} N at most, {:.2g} N for ever, {:.0f} x {:.0f} x {:.0f} mm",
                                        spec->name, spec->max_force_n, spec->max_continuous_force_n,
                                        1e3 * (spec->workspace_max_m.x - spec->workspace_min_m.x),
                                        1e3 * (spec->workspace_max_m.y - spec->workspace_min_m.y),
                                        1e3 * (spec->workspace_max_m.z - spec->workspace_min_m.z))
                          : spec.error().message});
  }
  const auto haply = HaplyDevice::query(settings.haply_port);
  lines.push_back({kHaplyDevice, haply.has_value(),
                   haply ? fmt::format("its service answers at port {}", settings.haply_port) : haply.error().message});
  look_for_gamepads(lines);
  lines.push_back({kSimulatedHand, true, "needs no device"});
  return lines;
}

}  // namespace afm::haptics
