// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/percentiles.h"
#include "core/result.h"
#include "scene/shared/shared_blocks.h"

namespace afm::app {

// Mica under a silicon nitride tip on a sample whose +z points up, as in docs/physics.md: the sample of the servo
// benchmarks.
scene::SharedModel mica_alone();

// Work of a servo tick with one law of force, microseconds.
struct WorkFigure {
  std::string name;
  core::Percentiles us;
  double p50_bar_us = 0;  // 0: none
  double p99_bar_us = 0;

  bool met() const { return (p50_bar_us == 0 || us.p50 <= p50_bar_us) && us.p99 <= p99_bar_us; }
};

// Ticks a servo loop with the simulated hand flat out, in simulated time, through one cycle after the other with the
// force on, and times every tick. Each law in turn; the paper's also over a plane.
core::Result<std::vector<WorkFigure>> measure_servo_work(std::size_t ticks);

}  // namespace afm::app
