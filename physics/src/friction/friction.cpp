// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/friction.h"

#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

namespace afm::physics {

std::optional<LatticeKind> lattice_kind_of(std::string_view word) {
  for (const LatticeKindText& row : kLatticeKinds) {
    if (row.word == word) return row.kind;
  }
  return std::nullopt;
}

namespace {

std::string laws_with_area() {
  std::string names;
  for (const LawTraits& row : kLawTable) {
    if (row.contact_radius != nullptr) names += (names.empty() ? "" : ", ") + std::string(row.name);
  }
  return names;
}

}  // namespace

Area contact_area(Law law, const ContactParameters& contact, Force force) {
  if (!has_contact_area(law)) {
    throw std::invalid_argument("the law " + std::string(name_of(law)) + " has no contact area; choose " +
                                laws_with_area());
  }
  const Length radius = traits_of(law).contact_radius(contact, force);
  return std::numbers::pi * radius * radius;
}

Stiffness tangential_contact_stiffness(Pressure reduced_shear_modulus, Length contact_radius) {
  return 8.0 * reduced_shear_modulus * contact_radius;
}

Pressure reduced_shear_modulus(Pressure tip_shear_modulus, double tip_poisson_ratio, Pressure sample_shear_modulus,
                               double sample_poisson_ratio) {
  return Pressure(1.0 / ((2.0 - tip_poisson_ratio) / tip_shear_modulus.si +
                         (2.0 - sample_poisson_ratio) / sample_shear_modulus.si));
}

}  // namespace afm::physics
