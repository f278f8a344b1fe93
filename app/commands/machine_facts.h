// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/bench/scheduling_latency.h"
#include "haptics/device_registry.h"
#include "render/context.h"

namespace afm::app {

// A device file in /dev.
struct DeviceNode {
  std::string path;
  bool accessible = false;  // for reading and writing, by this user
};

// Facts about this machine, without a verdict.
struct MachineFacts {
  std::string kernel;  // release, and how far it can be preempted
  std::uint64_t priority_limit = 0;
  std::optional<std::uint64_t> locked_memory_limit_bytes;  // empty: unlimited
  bool pages_can_be_locked = false;
  SchedulingLatency jitter;
  std::vector<render::DeviceDescription> graphics;
  std::string graphics_refusal;  // why there are none
  std::string display;           // empty: none
  std::string saver;             // ways to keep the screen saver off while a window is open
  bool saver_stays_off = false;
  std::string headset_manifest;  // of OpenXR's runtime; empty: none is installed
  std::string headset;           // what the runtime says; empty: it does not answer
  std::string headset_refusal;   // then why not
  std::vector<DeviceNode> render_nodes;
  std::vector<DeviceNode> hid_nodes;
  std::vector<DeviceNode> serial_nodes;
  std::vector<haptics::ProbeLine> haptics;
  std::string servo_program;
  bool servo_program_runs = false;  // is there and may be executed
};

// Examines the machine; takes slightly longer than `jitter_seconds`. `program` is the running touchafm.
MachineFacts look_at_machine(const core::Clock& clock, const std::string& program, double jitter_seconds);

}  // namespace afm::app
