// SPDX-License-Identifier: Apache-2.0
#include "physics/adhesive_contact.h"

#include "physics/contact.h"

namespace afm::physics {

AdhesiveContact adhesive_contact(const Interaction& interaction) {
  validate(interaction);
  if (!isfinite(interaction.reduced_modulus)) {
    throw UnphysicalValue("reduced_modulus",
                          "reduced modulus is infinite, and an elastic contact needs one of 1 Pa "
                          "to 10 TPa: give it, or choose a law of rigid bodies");
  }
  return {interaction.tip_radius, interaction.reduced_modulus, work_of_adhesion(interaction)};
}

}  // namespace afm::physics
