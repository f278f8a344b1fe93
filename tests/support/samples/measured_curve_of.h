// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "scene/shared/shared_blocks.h"

namespace afm::test {

// Gives a material the measured curve of a spring of 0.1 N/m, with jumps in at 2 nm and off at 14 nm.
inline void add_measured_curve(scene::SharedModel& model, std::size_t material) {
  model.materials[material].measured_curve = 0;
  model.curve_count = 1;
  scene::SharedMeasuredCurve& curve = model.curves[0];
  curve.approach_count = curve.retract_count = 200;
  for (std::size_t i = 0; i < 200; ++i) {
    const double z_m = 0.2e-9 * (static_cast<double>(i) - 50.0);
    const physics::Force line(-0.1 * z_m);
    curve.approach[i] = {physics::Length(z_m), z_m < 2e-9 ? line : physics::Force()};
    curve.retract[i] = {physics::Length(z_m), z_m < 14e-9 ? line : physics::Force()};
  }
}

}  // namespace afm::test
