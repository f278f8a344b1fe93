// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/percentiles.h"
#include "core/result.h"
#include "scene/shared/felt_heights.h"
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

// A topography as an instrument measures it, and the scale on which the hand feels it.
struct MeasuredSurface {
  std::string name;
  scene::Topography topography;
  scene::TopographyScale scale;
};

// One with the most points that are felt: hills and steps, with noise from point to point.
MeasuredSurface largest_measured_surface();

// Ticks a servo loop with the simulated hand flat out, in simulated time, through one cycle after the other with the
// force on, and times every tick. Each law in turn; the paper's also over a plane and over the measured surface.
core::Result<std::vector<WorkFigure>> measure_servo_work(std::size_t ticks, const MeasuredSurface& measured);

}  // namespace afm::app
