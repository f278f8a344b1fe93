// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "core/latest_value.h"
#include "drivers/command_fade.h"
#include "haptics/device.h"

namespace afm::haptics {

// Newest data of a device, from its driver.
struct DriverFrame {
  std::int64_t time_ns = 0;  // time of the position
  glm::dvec3 position_m{0.0};
  double motor_heat = 0;
  std::uint32_t turn_on = 0;
  std::uint32_t ready = 0;  // 1: all is well; 0: no force may be felt
};

// Exchange between the servo and the thread that runs a vendor's driver (docs/decisions/0005). Neither waits for the
// other, and each checks the age of the other's data.
class DriverMailbox {
 public:
  // A frame older than `stall_ns` counts as a failed device.
  explicit DriverMailbox(std::int64_t stall_ns) : stall_ns_(stall_ns) {}

  // servo's thread: HapticDevice::read() and write()
  DeviceSample read(std::int64_t now_ns) noexcept {
    tick_ns_ = now_ns;
    if (const auto frame = frames_.try_load()) seen_ = *frame;
    return {.position_m = seen_.position_m,
            .turn_on = seen_.turn_on != 0,
            .healthy = seen_.ready != 0 && now_ns - seen_.time_ns <= stall_ns_,
            .motor_heat = seen_.motor_heat};
  }
  void write(const ForceCommand& command) noexcept {
    commands_.store({.time_ns = tick_ns_, .force_n = command.force_n()});
  }

  // driver's thread
  void publish(const DriverFrame& frame) noexcept { frames_.store(frame); }

  // The servo's newest force, faded by its age; `elapsed_ns` after the last call.
  glm::dvec3 wanted_n(std::int64_t now_ns, std::int64_t elapsed_ns) noexcept {
    if (const auto command = commands_.try_load()) command_ = *command;
    return fade_.weighed_n(command_, now_ns, elapsed_ns);
  }

 private:
  std::int64_t stall_ns_;
  core::LatestValue<DriverFrame> frames_;
  core::LatestValue<TimedForce> commands_;

  // servo's thread
  DriverFrame seen_;
  std::int64_t tick_ns_ = 0;

  // driver's thread
  TimedForce command_;
  CommandFade fade_;
};

}  // namespace afm::haptics
