// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/bench/scheduling_latency.h"
#include "core/system_packages.h"
#include "haptics/device_registry.h"
#include "haptics/haptic_ports.h"
#include "render/context.h"

namespace afm::app {

// A device file in /dev.
struct DeviceNode {
  std::string path;
  bool accessible = false;  // true: readable and writable for the current user
};

// Facts about this machine, without a verdict.
struct MachineFacts {
  std::string kernel;  // release and preemption model
  std::uint64_t priority_limit = 0;
  std::optional<std::uint64_t> locked_memory_limit_bytes;  // empty: unlimited
  bool pages_can_be_locked = false;
  SchedulingLatency jitter;
  bool drawing_refused = false;  // true: request of haptics::favour_drawing() refused
  std::vector<render::DeviceDescription> graphics;
  std::string graphics_refusal;  // reason why `graphics` is empty
  std::string display;           // name of the display; empty: none
  std::string display_refusal;   // reason why `view` cannot open a window; empty: it can
  std::string saver;             // means of keeping the screen saver off while a window is open
  bool saver_stays_off = false;
  std::string headset_manifest;  // file of the OpenXR runtime; empty: not installed
  bool headset_manifest_exists = true;
  std::string headset;          // description from the runtime; empty: no answer
  std::string headset_refusal;  // reason for a missing answer
  std::vector<DeviceNode> render_nodes;
  std::vector<DeviceNode> hid_nodes;
  std::vector<haptics::HapticPort> haptic_ports;
  std::vector<haptics::ProbeLine> haptics;
  const core::PackageSystem* packages = nullptr;  // package system; null: an unknown distribution
  std::vector<core::SystemPart> missing_parts;    // missing parts other than drivers and fonts
  std::string servo_program;
  std::string missing_program;  // servo or watchdog that cannot be run; empty: none
};

// Examines the machine; takes slightly longer than `jitter_seconds`. `program` is the running touchafm.
MachineFacts look_at_machine(const core::Clock& clock, const std::string& program, double jitter_seconds);

}  // namespace afm::app
