// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/curve_analysis.h"
#include "physics/law_tables.h"

namespace afm::physics {

// A measured curve ready to be felt (measured_law_tables): smoothed, along rising Z, with Z = 0 at the contact point
// and the baseline subtracted. Its events are those of analyse(): the approach jumps where the snap-in is, or, without
// one, meets the contact at the contact point without a jump; the retract jumps where the tip lets go.
struct MeasuredBranches {
  std::vector<MeasuredPoint> approach;
  std::vector<MeasuredPoint> retract;
  MeasuredJumps jumps;
};

// Each branch is cut into bins of equal width along Z, from its deepest point to a half beyond the place where the tip
// lets go; a bin becomes one point, the mean of its Z and the median of its forces. Four samples fall into a bin on
// average, or more. The events' own points are kept as they are. At most `most_points` a branch. Throws
// std::invalid_argument as analyse() does, and if there is no contact point or no retract.
MeasuredBranches measured_branches(std::span<const CurvePoint> points, std::size_t most_points = 512);

}  // namespace afm::physics
