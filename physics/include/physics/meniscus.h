// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/force_law.h"
#include "physics/law.h"
#include "physics/units.h"

// The liquid bridge that humid air condenses between tip and sample, as simple as it can be: a force that does not
// depend on the gap while the bridge stands, one gap at which it forms and a larger one at which it breaks (Zitzler,
// Herminghaus & Mugele 2002). For wetting liquids, contact angles below 90 degrees. For any thread.
namespace afm::physics {

// F = 4 pi R gamma_L cos(theta), the Laplace pressure's pull on a sphere that touches a plane, as a magnitude (Butt,
// Cappella & Kappl 2005). It holds for a bridge much smaller than the tip, at any humidity.
Force capillary_force(const Meniscus& meniscus, Length tip_radius) noexcept;

// h = cbrt(A/(6 pi (R_gas T/V_m) ln(1/humidity))), the film of water that a wetted solid carries in vapour
// (Israelachvili, Intermolecular and Surface Forces, ch. 12), for A = 1e-20 J at 20 degrees Celsius: 0.18 nm at 50 %,
// 0.24 nm at 75 %. An estimate: real films depend on the solid.
Length film_height(const Meniscus& meniscus) noexcept;

// 2h: where the films of tip and sample touch and the bridge forms.
Length bridge_formation_gap(const Meniscus& meniscus) noexcept;

// cbrt(V), with V = 4 pi R h^2 the volume between sphere and plane in contact where they are closer than 2h: where a
// bridge of that volume breaks. Never below the gap of formation.
Length bridge_rupture_gap(const Meniscus& meniscus, Length tip_radius) noexcept;

// The law with a bridge: free until it forms, and attached, with the bridge's force added, until it breaks. Gaps are
// counted from where the dry law's contact begins. A contact whose neck ends before the bridge would break takes it
// along, and does not form from farther away than that end. A bridge is taken to store nothing when it breaks.
ForceLaw with_meniscus(const ForceLaw& law, const Meniscus& meniscus, Length tip_radius);

}  // namespace afm::physics
