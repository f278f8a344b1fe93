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

// Sources: bharatm11/Geomagic_Touch_ROS_Drivers #2 and #17, jsk_robot #1907 (a Touch has the vendor 2988, an older one
// 0301:2988; those sold since 2023 are HID devices without a serial port).
constexpr KnownPort kHdapiPorts[] = {
    {HapticBus::Serial, 0x2988, {}, "Touch", R"(SUBSYSTEM=="tty", ATTRS{idVendor}=="2988", TAG+="uaccess")"},
    {HapticBus::Serial, 0x0301, 0x2988, "Touch",
     R"(SUBSYSTEM=="tty", ATTRS{idVendor}=="0301", ATTRS{idProduct}=="2988", TAG+="uaccess")"},
    {HapticBus::Hid, 0x2988, {}, "Touch", R"(SUBSYSTEM=="hidraw", KERNELS=="*:2988:*", TAG+="uaccess")"},
};
// Source: sawForceDimensionSDK (1451, 0403:cb48).
constexpr KnownPort kForceDimensionPorts[] = {
    {HapticBus::Usb,
     0x1451,
     {},
     "Force Dimension device",
     R"(SUBSYSTEM=="usb", ATTR{idVendor}=="1451", TAG+="uaccess")"},
    {HapticBus::Usb, 0x0403, 0xcb48, "Novint Falcon",
     R"(SUBSYSTEM=="usb", ATTR{idVendor}=="0403", ATTR{idProduct}=="cb48", TAG+="uaccess")"},
};

constexpr std::array kDevices{
    DeviceKind{.word = "hdapi",
               .subject = "hdapi device",
               .meaning = "PHANTOM or Touch, through the manufacturer's library",
               .renders_force = true,
               .vibrates = true,
               .controls = HandControls::Pen,
               .remedy = "switch it on and run the manufacturer's set-up program",
               .proof = "tested with a stand-in for its library only",
               .models = "hdapi hd 3d geomagic sensable phantom premium omni desktop touch x stylus device mock",
               .ports = kHdapiPorts,
               .open = open_hdapi,
               .probe = probe_hdapi},
    DeviceKind{
        .word = "forcedimension",
        .subject = "forcedimension device",
        .meaning = "omega, delta, sigma, lambda or Falcon, through Force Dimension's library",
        .renders_force = true,
        .vibrates = true,
        .controls = HandControls::Device,
        .remedy = "switch it on and run the manufacturer's test program",
        .proof = "tested with a stand-in for its library only",
        .models =
            "forcedimension force dimension novint falcon omega.3 omega.6 omega.7 delta.3 delta.6 sigma.3 sigma.7 "
            "lambda.3 lambda.6 lambda.7 device virtual mock",
        .ports = kForceDimensionPorts,
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
               .models = "haply inverse3 inverse3x minverse mini device",
               .ports = {},
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
               .models = "gamepad joystick controller sony dualsense dualshock playstation ps4 ps5 nintendo switch "
                         "xbox 360 one series "
                         "x logitech usb wireless",
               .ports = {},
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
               .models = "simulated",
               .ports = {},
               .open = open_simulated,
               .probe = probe_simulated},
};

static_assert(std::none_of(kDevices.begin(), kDevices.end(),
                           [](const DeviceKind& kind) { return kind.models.empty(); }));

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
