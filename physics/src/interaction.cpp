// SPDX-License-Identifier: Apache-2.0
#include "physics/interaction.h"

#include <stdexcept>
#include <string>

#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

using namespace literals;  // NOLINT: the only way to reach literals, inside this file alone

template <class Q>
void require_range(const char* name, Q value, Q smallest, Q largest, const UnitList<Q>& units) {
  // written so that NaN fails
  if (value >= smallest && value <= largest) return;
  throw std::invalid_argument(std::string(name) + " " + format_quantity(value, units) + " is not within " +
                              format_quantity(smallest, units) + " to " + format_quantity(largest, units));
}

}  // namespace

void validate(const Interaction& interaction) {
  const Stiffness infinite(HUGE_VAL);
  require_range("tip radius", interaction.tip_radius, 0.1_nm, 1_mm, kLengthUnits);
  require_range("spring constant", interaction.spring_constant, 1e-6_N_per_m, 1e6_N_per_m, kStiffnessUnits);
  require_range("sample stiffness", interaction.sample_stiffness, 1e-6_N_per_m, infinite, kStiffnessUnits);
  require_range("hamaker constant", interaction.hamaker, 1e-24_J, 1e-16_J, kEnergyUnits);
  require_range("mean surface energy", interaction.mean_surface_energy, 1e-9_J_per_m2, 100_J_per_m2,
                kSurfaceEnergyUnits);
}

}  // namespace afm::physics
