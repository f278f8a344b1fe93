// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/adhesive_contact.h"
#include "physics/units.h"

// The contact of a soft, strongly adhering sphere: Johnson, Kendall & Roberts 1971. The contact radius a is its natural
// parameter: load and indentation are functions of a, but not vice versa. Loads are positive if the tip is pressed,
// indentations negative if a neck has been drawn out. Any thread.
namespace afm::physics {

// P = 4 E* a^3/(3R) - sqrt(8 pi W E* a^3).
Force jkr_load(const AdhesiveContact& contact, Length contact_radius) noexcept;

// delta = a^2/R - sqrt(2 pi W a/E*).
Length jkr_indentation(const AdhesiveContact& contact, Length contact_radius) noexcept;

// U = E* (delta^2 a - 2 delta a^3/(3R) + a^5/(5 R^2)) - pi a^2 W, elastic and surface energy: at rest P = dU/d delta.
Energy jkr_energy(const AdhesiveContact& contact, Length contact_radius) noexcept;

// a = cbrt(3R/(4 E*) [P + 3 pi W R + sqrt(6 pi W R P + (3 pi W R)^2)]), the stable one of the radii at the load P.
// Throws std::invalid_argument for a load below the pull-off.
Length jkr_contact_radius(const AdhesiveContact& contact, Force load);

// Pull-off at a given load: P = -3/2 pi W R.
Force jkr_pull_off_load(const AdhesiveContact& contact) noexcept;

// Pull-off at a given indentation (fixed grips; Maugis, Contact, Adhesion and Rupture, 2000): a^3 = pi W R^2/(8 E*), P
// = -5/6 pi W R, delta = -3/4 cbrt(pi^2 W^2 R/E*^2).
Length jkr_fixed_grips_radius(const AdhesiveContact& contact) noexcept;

}  // namespace afm::physics
