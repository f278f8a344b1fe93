// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "physics/curve_analysis.h"

namespace afm::physics {

// Pull-off, adhesion, release point, and the energies of a cycle above its baseline, whose first `approach_count`
// points are its approach. `features` contains the contact point, if there is one.
void analyse_retract(std::span<const CurvePoint> cycle, std::size_t approach_count, Force threshold,
                     ForceZero zero_of_force, CurveFeatures& features);

}  // namespace afm::physics
