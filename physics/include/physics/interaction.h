// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/units.h"

namespace afm::physics {

// What one choice of tip, lever, sample and medium is to the paper's force law (Liu & Peng, Table 1).
struct Interaction {
  Length tip_radius;                  // R
  Stiffness spring_constant;          // k_c, of the cantilever
  Stiffness sample_stiffness;         // k_s, infinite for a rigid sample
  Energy hamaker;                     // A_H, of tip and sample across the medium
  SurfaceEnergy mean_surface_energy;  // sqrt(gamma_s gamma_t), half of the work of adhesion (3.3)
};

// Throws std::invalid_argument, quoting the value and the legal range, unless every value is a number inside the range
// of what force microscopes are made of: R 0.1 nm to 1 mm, k_c 1 uN/m to 1 MN/m, k_s 1 uN/m to infinity,
// A_H 1e-24 J to 1e-16 J, sqrt(gamma_s gamma_t) 1 nJ/m^2 to 100 J/m^2.
void validate(const Interaction& interaction);

}  // namespace afm::physics
