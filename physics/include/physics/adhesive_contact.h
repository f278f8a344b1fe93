// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/contact_parameters.h"
#include "physics/units.h"

namespace afm::physics {

// An elastic sphere that adheres to an elastic half-space, as in the contact mechanics of Hertz, DMT, JKR and Maugis.
// Values are within the ranges of validate(); the modulus is finite.
struct AdhesiveContact {
  Length tip_radius;               // R, radius of the tip
  Pressure reduced_modulus;        // E*, reduced modulus
  SurfaceEnergy work_of_adhesion;  // W, work of adhesion
};

// Throws as validate() does, and UnphysicalValue if the modulus is infinite, because contact mechanics does not apply
// to rigid bodies.
AdhesiveContact adhesive_contact(const ContactParameters& contact);

}  // namespace afm::physics
