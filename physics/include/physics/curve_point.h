// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/force_curve.h"
#include "physics/units.h"

namespace afm::physics {

// One point of any curve, simulated or measured: the height of the lever's base, which decreases while the tip
// approaches and has an unknown offset in a measured curve, and the lever's force, positive away from the sample.
struct CurvePoint {
  Length z;
  Force force;
  Branch branch = Branch::Approach;
};

}  // namespace afm::physics
