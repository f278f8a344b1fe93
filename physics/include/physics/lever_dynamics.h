// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

namespace afm::physics {

// Properties of a lever, in addition to its spring constant, for motion as a point mass: m z'' + (k/(w0 Q)) z' + k (z -
// Z) = F, with w0 = 2 pi f0 and m = k/w0^2.
struct LeverDynamics {
  Frequency resonance;          // f0, resonance in the medium
  double quality_factor = 1.0;  // Q, quality factor in the medium
  Temperature temperature;      // temperature of the lever; 0 K: no thermal noise
};

// Throws UnphysicalValue unless f0 is within 1 Hz to 100 MHz, Q within 0.01 to 1e7 and T within 0 to 2000 K.
void validate(const LeverDynamics& lever);

}  // namespace afm::physics
