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

// Sample of the servo benchmarks: mica under a silicon nitride tip, as in docs/physics.md, +z upwards.
scene::SharedModel mica_alone();

// Duration of a servo tick with one force law, microseconds.
struct WorkFigure {
  std::string name;
  core::Percentiles us;
  double p50_bar_us = 0;  // goal for the median; 0: none
  double p99_bar_us = 0;

  bool met() const { return (p50_bar_us == 0 || us.p50 <= p50_bar_us) && us.p99 <= p99_bar_us; }
};

// A topography as measured by an instrument, and the scale at which the hand feels it.
struct MeasuredSurface {
  std::string name;
  scene::Topography topography;
  scene::TopographyScale scale;
};

// A surface with the largest number of points that can be felt: hills and steps with noise at each point.
MeasuredSurface largest_measured_surface();

// Ticks a servo loop with the simulated hand at full speed, in simulated time, through repeated cycles with the force
// on, and times every tick. Measures each law in turn, the paper's also over a plane and over the measured surface,
// a map of modulus and adhesion, and a lever in tapping mode; then the work of a tick in which the tip scratches a soft
// sample, or writes with ink.
core::Result<std::vector<WorkFigure>> measure_servo_work(std::size_t ticks, const MeasuredSurface& measured);

}  // namespace afm::app
