// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/force_law.h"
#include "physics/law.h"
#include "physics/units.h"

// The liquid bridge that humid air condenses between tip and sample, in the simplest model: a constant force while the
// bridge exists, one gap at which it forms and a larger one at which it breaks (Zitzler, Herminghaus & Mugele 2002).
// For wetting liquids, contact angles below 90 degrees. Any thread.
namespace afm::physics {

// F = 4 pi R gamma_L cos(theta), the magnitude of the Laplace pressure's pull on a sphere that touches a plane (Butt,
// Cappella & Kappl 2005). Valid for a bridge much smaller than the tip, at any humidity.
Force capillary_force(const Meniscus& meniscus, Length tip_radius) noexcept;

// h = cbrt(A/(6 pi (R_gas T/V_m) ln(1/humidity))), the thickness of the water film on a wetted solid in vapour
// (Israelachvili, Intermolecular and Surface Forces, ch. 12), for A = 1e-20 J at 20 degrees Celsius: 0.18 nm at 50 %,
// 0.24 nm at 75 %. An estimate: real films depend on the solid.
Length film_height(const Meniscus& meniscus) noexcept;

// Gap 2h at which the films of tip and sample touch and the bridge forms.
Length bridge_formation_gap(const Meniscus& meniscus) noexcept;

// cbrt(V), with V = 4 pi R h^2 the volume between sphere and plane in contact where they are closer than 2h: the gap at
// which a bridge of that volume breaks. Never below the gap of formation.
Length bridge_rupture_gap(const Meniscus& meniscus, Length tip_radius) noexcept;

// The law with a bridge: free until it forms, and attached, with the bridge's force added, until it breaks. Gaps are
// counted from the beginning of the dry law's contact. If the contact's neck ends before the bridge would break, the
// bridge breaks with it and does not form from farther away than that end. A breaking bridge is assumed to have no
// stored energy.
ForceLaw with_meniscus(const ForceLaw& law, const Meniscus& meniscus, Length tip_radius);

}  // namespace afm::physics
