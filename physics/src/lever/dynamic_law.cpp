// SPDX-License-Identifier: Apache-2.0
#include "physics/dynamic_law.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace afm::physics {

std::shared_ptr<const LawTables> fixed_grips_tables(Law law, const ContactParameters& contact,
                                                    const LawOptions& options) {
  if (!has_dynamics(law)) {
    std::string others;
    for (const Law other : laws_with(&LawTraits::dynamic)) {
      others += (others.empty() ? "" : ", ") + std::string(name_of(other));
    }
    throw std::invalid_argument("the law " + std::string(name_of(law)) + " has no dynamics: take one of " + others);
  }
  if (traits_of(law).modulus != ModulusUse::Unused && std::isinf(contact.reduced_modulus.si)) {
    throw UnphysicalValue("reduced_modulus", "a rigid contact has no dynamics: give it a finite reduced modulus");
  }
  validate(contact);
  ContactParameters fixed_grips = contact;
  fixed_grips.spring_constant = Stiffness(std::numeric_limits<double>::infinity());
  return build_law_tables(law, fixed_grips, options);
}

}  // namespace afm::physics
