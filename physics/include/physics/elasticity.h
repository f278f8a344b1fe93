// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

namespace afm::physics {

// An isotropic elastic body.
struct Elasticity {
  Pressure modulus;  // Young's modulus
  double poisson_ratio = 0.0;
};

// E* of two bodies in contact, 1/E* = (1 - nu_t^2)/E_t + (1 - nu_s^2)/E_s (Hertz 1881). Throws UnphysicalValue with the
// field tip_modulus, tip_poisson_ratio, sample_modulus or sample_poisson_ratio unless the moduli are within 1 Pa to 10
// TPa and Poisson's ratios above -1 and at most 0.5.
Pressure reduced_modulus(const Elasticity& tip, const Elasticity& sample);

}  // namespace afm::physics
