// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "physics/force_curve.h"
#include "physics/units.h"

namespace afm::physics {

// Where a branch of a curve is pulled hardest. The force is signed: it is zero or negative, and zero where nothing
// pulls.
struct Extreme {
  Length z;
  Force force;
};

// What the samples alone say about a curve.
struct CurveSummary {
  Extreme approach;    // its force is -F_attr
  Extreme retract;     // its force is -F_ad
  Energy loop_energy;  // what the hand put in and did not get back: -closed integral of F dZ, by trapezoids
};

// For samples in the order of the cycle. The loop is closed only if the first and the last sample share their Z.
CurveSummary summarise(std::span<const CurveSample> samples);

}  // namespace afm::physics
