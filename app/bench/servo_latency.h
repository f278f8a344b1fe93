// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "app/bench/scheduling_latency.h"
#include "core/result.h"
#include "scene/shared/shared_blocks.h"

namespace afm::app {

// Wake-up latency of the servo's thread and of a plain loop that runs at the same time, rate and priority.
struct ServoWake {
  scene::ServoTiming servo;
  SchedulingLatency plain;
  std::uint64_t frames = 0;  // number drawn during the measurement
};

// Runs touchafm-servo, from the folder of `program`, with the simulated hand for `seconds`. Meanwhile calls `draw`
// repeatedly; it must return within 250 ms, or the servo assumes that the renderer hangs. Without `draw` the caller
// sleeps.
core::Result<ServoWake> measure_servo_wake(const std::string& program, double seconds,
                                           const std::function<void()>& draw = {});

}  // namespace afm::app
