// SPDX-License-Identifier: Apache-2.0
#include "physics/interaction.h"

#include <limits>

#include "require_range.h"

namespace afm::physics {

using namespace literals;

void validate(const Interaction& interaction) {
  const Stiffness infinite(std::numeric_limits<double>::infinity());
  require_range("tip_radius", interaction.tip_radius, 0.1_nm, 1_mm, kLengthUnits);
  require_range("spring_constant", interaction.spring_constant, 1e-6_N_per_m, 1e6_N_per_m, kStiffnessUnits);
  require_range("sample_stiffness", interaction.sample_stiffness, 1e-6_N_per_m, infinite, kStiffnessUnits);
  require_range("hamaker", interaction.hamaker, 1e-24_J, 1e-16_J, kEnergyUnits);
  require_range("mean_surface_energy", interaction.mean_surface_energy, 1e-9_J_per_m2, 100_J_per_m2,
                kSurfaceEnergyUnits);
  const bool rigid = interaction.reduced_modulus == Pressure(std::numeric_limits<double>::infinity());
  if (!rigid) require_range("reduced_modulus", interaction.reduced_modulus, 1_Pa, 10000_GPa, kPressureUnits);
  require_range("atomic_distance", interaction.atomic_distance, 0.05_nm, 5_nm, kLengthUnits);
}

}  // namespace afm::physics
