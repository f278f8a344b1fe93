// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/adhesive_contact.h"
#include "physics/units.h"

// Elastic contact without adhesion (Hertz 1882; Johnson, Contact Mechanics, ch. 4), and with a constant adhesion that
// leaves its shape as it is (Derjaguin, Muller & Toporov 1975). Loads are positive where the tip is pressed. Both hold
// for a contact radius a << R; for any thread.
namespace afm::physics {

// 4/3 E* sqrt(R) delta^(3/2) for an indentation delta >= 0, and 0 for a tip that does not touch.
Force hertz_load(const AdhesiveContact& contact, Length indentation) noexcept;

// delta = a^2/R.
Length hertz_indentation(const AdhesiveContact& contact, Length contact_radius) noexcept;

// a = cbrt(3 R P/(4 E*)) for a load P >= 0.
Length hertz_contact_radius(const AdhesiveContact& contact, Force load) noexcept;

// dP/d delta = 2 E* a, of a contact of the radius a; the same for DMT.
Stiffness hertz_stiffness(const AdhesiveContact& contact, Length contact_radius) noexcept;

// 2 pi R W: what adds to DMT's load, and the pull-off force, whatever the lever.
Force dmt_adhesion(const AdhesiveContact& contact) noexcept;

// a = cbrt(3 R (P + 2 pi R W)/(4 E*)) for a load P >= -2 pi R W.
Length dmt_contact_radius(const AdhesiveContact& contact, Force load) noexcept;

}  // namespace afm::physics
