// SPDX-License-Identifier: Apache-2.0
#include "haptics/device_registry.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <string>
#include <utility>

#include "core/check.h"
#include "devices/gamepad_device.h"
#include "devices/haply_device.h"
#include "devices/hdapi_device.h"
#include "devices/opening_limit.h"
#include "forcedimension/dhd_device.h"
#include "haptics/simulated_device.h"

namespace afm::haptics {

namespace {

void probe_simulated(const Environment& /*environment*/, ProbeLog& log) { log.found("needs no device"); }

core::Result<std::unique_ptr<HapticDevice>> open_simulated(const DeviceRequest& request, ProbeLog& log) {
  probe_simulated(request.environment, log);
  return std::make_unique<SimulatedDevice>();
}

constexpr std::array kDevices{
    DeviceKind{.word = "hdapi",
               .subject = "hdapi device",
               .meaning = "PHANTOM or Touch, through the manufacturer's library",
               .renders_force = true,
               .vibrates = true,
               .controls = HandControls::Pen,
               .remedy = "switch it on and run the manufacturer's set-up program",
               .proof = "tested with a stand-in for its library only",
               .open = open_hdapi,
               .probe = probe_hdapi},
    DeviceKind{.word = "forcedimension",
               .subject = "forcedimension device",
               .meaning = "omega, delta, sigma, lambda or Falcon, through Force Dimension's library",
               .renders_force = true,
               .vibrates = true,
               .controls = HandControls::Device,
               .remedy = "switch it on and run the manufacturer's test program",
               .proof = "tested with a stand-in for its library only",
               .open = open_force_dimension,
               .probe = probe_force_dimension},
    DeviceKind{.word = "haply",
               .subject = "haply device",
               .meaning = "Inverse3, Inverse3x or Minverse, through the manufacturer's service",
               .renders_force = true,
               .vibrates = true,
               .controls = HandControls::Grip,
               .remedy = {},
               .proof = "tested with a stand-in for its service only",
               .open = open_haply,
               .probe = probe_haply},
    DeviceKind{.word = "gamepad",
               .subject = "gamepad",
               .meaning = "game controller or joystick",
               .renders_force = false,
               .vibrates = false,
               .controls = HandControls::Gamepad,
               .remedy = {},
               .proof = {},
               .open = open_gamepad,
               .probe = probe_gamepads},
    DeviceKind{.word = "sim",
               .subject = "simulated hand",
               .meaning = "simulated user",
               .renders_force = false,
               .vibrates = true,
               .controls = HandControls::Simulated,
               .remedy = {},
               .proof = {},
               .open = open_simulated,
               .probe = probe_simulated},
};

core::Result<std::unique_ptr<HapticDevice>> open_kind(const DeviceKind& kind, const DeviceRequest& request,
                                                      std::vector<ProbeLine>& lines,
                                                      std::chrono::milliseconds patience = kOpeningPatience) {
  const OpeningLimit limit(std::string(kind.subject), patience);
  ProbeLog log(kind.subject);
  auto device = kind.open(request, log);
  lines.insert(lines.end(), log.lines().begin(), log.lines().end());
  return device;
}

}  // namespace

std::span<const DeviceKind> device_kinds() { return kDevices; }

const DeviceKind& simulated_kind() { return kDevices.back(); }

const DeviceKind* find_device_kind(std::string_view word) {
  const auto found =
      std::find_if(kDevices.begin(), kDevices.end(), [&](const DeviceKind& kind) { return kind.word == word; });
  return found == kDevices.end() ? nullptr : &*found;
}

core::Result<OpenedDevice> open_device(const DeviceKind& kind, const Environment& environment, const core::Clock& clock,
                                       const OfferReleasePath& offer, std::chrono::milliseconds patience) {
  OpenedDevice opened;
  auto device = open_kind(kind, {environment, clock, DeviceChoice::ByName, offer}, opened.lines, patience);
  if (!device) return tl::unexpected(device.error());
  opened.device = std::move(*device);
  return opened;
}

OpenedDevice open_best_device(const Environment& environment, const core::Clock& clock, const OfferReleasePath& offer) {
  OpenedDevice opened;
  for (const DeviceKind& kind : kDevices) {
    auto device = open_kind(kind, {environment, clock, DeviceChoice::Automatic, offer}, opened.lines);
    if (!device) continue;
    opened.device = std::move(*device);
    break;
  }
  AFM_CHECK(opened.device != nullptr);
  return opened;
}

std::vector<ProbeLine> probe_devices(const Environment& environment, std::chrono::milliseconds patience) {
  std::vector<ProbeLine> lines;
  for (const DeviceKind& kind : kDevices) {
    const OpeningLimit limit(std::string(kind.subject), patience);
    ProbeLog log(kind.subject);
    kind.probe(environment, log);
    for (ProbeLine line : log.lines()) {
      if (line.usable && line.subject == kind.subject && !kind.proof.empty())
        line.said += fmt::format("; {}", kind.proof);
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

}  // namespace afm::haptics
