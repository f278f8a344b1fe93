// SPDX-License-Identifier: Apache-2.0
#include "physics/hertz.h"

#include <cmath>
#include <numbers>

namespace afm::physics {

Force hertz_load(const AdhesiveContact& contact, Length indentation) noexcept {
  if (!(indentation > Length())) return Force();
  return 4.0 / 3.0 * contact.reduced_modulus * indentation * sqrt(contact.tip_radius * indentation);
}

Length hertz_contact_radius(const AdhesiveContact& contact, Force load) noexcept {
  return cbrt(3.0 * contact.tip_radius * load / (4.0 * contact.reduced_modulus));
}

Stiffness hertz_stiffness(const AdhesiveContact& contact, Length contact_radius) noexcept {
  return 2.0 * contact.reduced_modulus * contact_radius;
}

Force dmt_adhesion(const AdhesiveContact& contact) noexcept {
  return 2.0 * std::numbers::pi * contact.tip_radius * contact.work_of_adhesion;
}

Length dmt_contact_radius(const AdhesiveContact& contact, Force load) noexcept {
  return hertz_contact_radius(contact, load + dmt_adhesion(contact));
}

}  // namespace afm::physics
