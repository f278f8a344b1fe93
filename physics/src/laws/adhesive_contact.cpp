// SPDX-License-Identifier: Apache-2.0
#include "physics/adhesive_contact.h"

#include "physics/contact.h"

namespace afm::physics {

AdhesiveContact adhesive_contact(const ContactParameters& contact) {
  validate(contact);
  if (!isfinite(contact.reduced_modulus)) {
    throw UnphysicalValue("reduced_modulus", "reduced modulus is infinite, and an elastic contact needs one of " +
                                                 contact_field("reduced_modulus").range() +
                                                 ": give it, or choose a law of rigid bodies");
  }
  return {contact.tip_radius, contact.reduced_modulus, work_of_adhesion(contact)};
}

}  // namespace afm::physics
