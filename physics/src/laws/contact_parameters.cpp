// SPDX-License-Identifier: Apache-2.0
#include "physics/contact_parameters.h"

#include <limits>

#include "require_range.h"

namespace afm::physics {

using namespace literals;

void validate(const ContactParameters& contact) {
  const Stiffness infinite(std::numeric_limits<double>::infinity());
  require_range("tip_radius", contact.tip_radius, 0.1_nm, 1_mm, kLengthUnits);
  require_range("spring_constant", contact.spring_constant, 1e-6_N_per_m, 1e6_N_per_m, kStiffnessUnits);
  require_range("sample_stiffness", contact.sample_stiffness, 1e-6_N_per_m, infinite, kStiffnessUnits);
  require_range("hamaker", contact.hamaker, 1e-24_J, 1e-16_J, kEnergyUnits);
  require_range("mean_surface_energy", contact.mean_surface_energy, 1e-9_J_per_m2, 100_J_per_m2, kSurfaceEnergyUnits);
  const bool rigid = contact.reduced_modulus == Pressure(std::numeric_limits<double>::infinity());
  if (!rigid) require_range("reduced_modulus", contact.reduced_modulus, 1_Pa, 10000_GPa, kPressureUnits);
  require_range("atomic_distance", contact.atomic_distance, 0.05_nm, 5_nm, kLengthUnits);
}

}  // namespace afm::physics
