// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/friction.h"

#include <numbers>
#include <stdexcept>
#include <string>

namespace afm::physics {

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

}  // namespace afm::physics
