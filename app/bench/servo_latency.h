// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "app/bench/scheduling_latency.h"
#include "core/result.h"
#include "scene/shared/shared_blocks.h"

namespace afm::app {

// How late the servo's own thread wakes, beside a plain loop at the same rate and priority at the same time.
struct ServoWake {
  scene::ServoTiming servo;
  SchedulingLatency plain;
  std::uint64_t frames = 0;  // drawn meanwhile
};

// Runs touchafm-servo, which lies beside `program`, with the simulated hand for `seconds`. `draw` is called over and
// over meanwhile and must return within 250 ms, or the servo takes the renderer for hung; without one the caller
// sleeps.
core::Result<ServoWake> measure_servo_wake(const std::string& program, double seconds,
                                           const std::function<void()>& draw = {});

}  // namespace afm::app
