// SPDX-License-Identifier: Apache-2.0
#include "physics/law.h"

#include <array>
#include <string>

#include "require_range.h"

namespace afm::physics {
namespace {

struct NamedLaw {
  Law law;
  std::string_view name;
};

constexpr std::array kLaws{
    NamedLaw{Law::Paper, "paper"},     NamedLaw{Law::Hao, "hao"},           NamedLaw{Law::Hertz, "hertz"},
    NamedLaw{Law::Dmt, "dmt"},         NamedLaw{Law::Jkr, "jkr"},           NamedLaw{Law::MaugisDugdale, "maugis"},
    NamedLaw{Law::LennardJones, "lj"}, NamedLaw{Law::Measured, "measured"},
};

// The same for what has no unit that a list knows.
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

std::string_view name_of(Law law) {
  for (const NamedLaw& named : kLaws) {
    if (named.law == law) return named.name;
  }
  return "unknown";
}

std::optional<Law> law_of(std::string_view name) {
  for (const NamedLaw& named : kLaws) {
    if (named.name == name) return named.law;
  }
  return std::nullopt;
}

}  // namespace afm::physics
