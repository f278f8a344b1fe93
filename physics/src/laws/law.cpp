// SPDX-License-Identifier: Apache-2.0
#include "physics/law.h"

#include <string>

#include "require_range.h"

namespace afm::physics {
namespace {

// Throws as require_range() of require_range.h, for a value without a unit list.
void require_range(const std::string& field, double value, double smallest, double largest, const std::string& what) {
  if (value >= smallest && value <= largest) return;
  throw UnphysicalValue(field, what + " " + std::to_string(value) + " is not within " + std::to_string(smallest) +
                                   " to " + std::to_string(largest));
}

}  // namespace

void validate(const LawOptions& options) {
  using namespace literals;
  if (options.retardation_wavelength) {
    require_range("retardation_wavelength", *options.retardation_wavelength, 1_nm, 100_um, kLengthUnits);
  }
  if (!options.meniscus) return;
  require_range("surface_tension", options.meniscus->surface_tension, 0.1_mJ_per_m2, 10_J_per_m2, kSurfaceEnergyUnits);
  require_range("contact_angle_rad", options.meniscus->contact_angle_rad, 0.0, 1.57, "contact angle in radians");
  require_range("relative_humidity", options.meniscus->relative_humidity, 0.01, 0.99, "relative humidity");
}

std::vector<Law> laws_with(bool LawTraits::* trait) {
  std::vector<Law> laws;
  for (const LawTraits& row : kLawTable) {
    if (row.*trait) laws.push_back(row.law);
  }
  return laws;
}

std::string_view name_of(Law law) { return is_known(law) ? traits_of(law).name : "unknown"; }

std::optional<Law> law_of(std::string_view name) {
  for (const LawTraits& row : kLawTable) {
    if (row.name == name) return row.law;
  }
  return std::nullopt;
}

}  // namespace afm::physics
