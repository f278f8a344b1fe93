// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/adhesive_contact.h"
#include "physics/units.h"

// Elastic contact without adhesion (Hertz 1882; Johnson, Contact Mechanics, ch. 4), and with a constant adhesion that
// does not change its shape (Derjaguin, Muller & Toporov 1975). Loads are positive if the tip is pressed. Valid for a
// contact radius a << R. Any thread.
namespace afm::physics {

// 4/3 E* sqrt(R) delta^(3/2) for an indentation delta >= 0; 0 for a tip without contact.
Force hertz_load(const AdhesiveContact& contact, Length indentation) noexcept;

// a = cbrt(3 R P/(4 E*)) for a load P >= 0.
Length hertz_contact_radius(const AdhesiveContact& contact, Force load) noexcept;

// dP/d delta = 2 E* a for a contact radius a; the same for DMT.
Stiffness hertz_stiffness(const AdhesiveContact& contact, Length contact_radius) noexcept;

// 2 pi R W, the adhesion in DMT's load; equals the pull-off force for any lever.
Force dmt_adhesion(const AdhesiveContact& contact) noexcept;

// a = cbrt(3 R (P + 2 pi R W)/(4 E*)) for a load P >= -2 pi R W.
Length dmt_contact_radius(const AdhesiveContact& contact, Force load) noexcept;

}  // namespace afm::physics
