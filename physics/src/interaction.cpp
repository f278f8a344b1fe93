// SPDX-License-Identifier: Apache-2.0
#include "physics/interaction.h"

#include <algorithm>
#include <limits>
#include <string>

#include "physics/quantity_text.h"

namespace afm::physics {
namespace {

using namespace literals;

// `field` is the member's name; with blanks for underscores it is what a person reads.
template <class Q>
void require_range(const std::string& field, Q value, Q smallest, Q largest, const UnitList<Q>& units) {
  // written so that NaN fails
  if (value >= smallest && value <= largest) return;
  std::string words = field;
  std::replace(words.begin(), words.end(), '_', ' ');
  throw UnphysicalValue(field, words + " " + format_quantity(value, units) + " is not within " +
                                   format_quantity(smallest, units) + " to " + format_quantity(largest, units));
}

}  // namespace

void validate(const Interaction& interaction) {
  const Stiffness infinite(std::numeric_limits<double>::infinity());
  require_range("tip_radius", interaction.tip_radius, 0.1_nm, 1_mm, kLengthUnits);
  require_range("spring_constant", interaction.spring_constant, 1e-6_N_per_m, 1e6_N_per_m, kStiffnessUnits);
  require_range("sample_stiffness", interaction.sample_stiffness, 1e-6_N_per_m, infinite, kStiffnessUnits);
  require_range("hamaker", interaction.hamaker, 1e-24_J, 1e-16_J, kEnergyUnits);
  require_range("mean_surface_energy", interaction.mean_surface_energy, 1e-9_J_per_m2, 100_J_per_m2,
                kSurfaceEnergyUnits);
}

}  // namespace afm::physics
