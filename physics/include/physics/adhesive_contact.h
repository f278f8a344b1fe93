// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/contact_parameters.h"
#include "physics/units.h"

namespace afm::physics {

// An elastic sphere that adheres to an elastic half-space, as the contact mechanics of Hertz, DMT, JKR and Maugis see
// it. Values within the ranges of validate(), the modulus finite.
struct AdhesiveContact {
  Length tip_radius;               // R
  Pressure reduced_modulus;        // E*
  SurfaceEnergy work_of_adhesion;  // W
};

// Throws as validate() does, and UnphysicalValue if the modulus is infinite: a rigid contact has no contact mechanics.
AdhesiveContact adhesive_contact(const ContactParameters& contact);

}  // namespace afm::physics
