// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fits/indenter.h"

namespace afm::fits {

// Lever and contact in series (F7): d + F(d)/k = way, without adhesion.
struct InSeries {
  double depth_m = 0;
  Push push;  // at that depth
};

// `way_m`, positive, is the way of the base beyond the contact point; `near_m` a depth from which the search begins.
InSeries in_series(const Indenter& indenter, double modulus_pa, double spring_n_per_m, double way_m, double near_m);

}  // namespace afm::fits
