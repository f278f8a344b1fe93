// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/curve_analysis.h"
#include "physics/law_tables.h"

namespace afm::physics {

// A measured curve prepared for the hand (measured_law_tables): smoothed, along rising Z, with Z = 0 at the contact
// point and the baseline subtracted. Its events are those of analyse(): the approach jumps at the snap-in or, without
// one, reaches the contact at the contact point without a jump; the retract jumps where the tip is released.
struct MeasuredBranches {
  std::vector<MeasuredPoint> approach;
  std::vector<MeasuredPoint> retract;
  MeasuredJumps jumps;
};

// Cuts each branch into bins of equal width along Z, from its deepest point to half as far again beyond the release; a
// bin becomes one point, with the mean of its Z and the median of its forces. A bin contains at least four samples on
// average. The events' own points are preserved. At most `most_points` per branch. Throws std::invalid_argument as
// analyse() does, and if there is no contact point or no retract.
MeasuredBranches measured_branches(std::span<const CurvePoint> points, std::size_t most_points = 512);

}  // namespace afm::physics
