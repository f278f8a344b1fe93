// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "physics/friction/sideways.h"
#include "physics/units.h"

namespace afm::physics {

// A point of a friction loop: the position x of the tip's holder and the lateral force on it, positive if it is pulled
// back along -x.
struct LateralPoint {
  Length place;
  Force force;
};

// A position of the tip's holder on the sample, and the lateral force on the tip there.
struct SidewaysPoint {
  Sideways<Length> place;
  Sideways<Force> force;
};

// Projects the points to the line through the origin along which the positions vary most, oriented to +x.
std::vector<LateralPoint> along_main_line(std::span<const SidewaysPoint> points);

// Results of a friction loop. Forces and positions as in LateralPoint.
struct FrictionLoop {
  Force half_width;   // friction force: half the difference of the forward and the backward stroke's mean
  Force offset;       // half the sum of both strokes' means: independent of the direction, from a slope or crosstalk
  Stiffness slope;    // dF/dx after a turn, while the tip sticks
  Energy dissipated;  // energy dissipated per cycle, between its turning points
  std::size_t begin = 0, turn = 0, end = 0;  // indices in the run where the cycle begins, turns and ends
};

// The last complete cycle of a run back and forth over the sample, in order of time: two strokes of opposite
// directions, each longer than the distance over which the tip sticks after its turn. The stroke in progress counts as
// soon as it is long enough. The means exclude the sticking distance at both ends. Empty if there is no such cycle, or
// no friction in it.
std::optional<FrictionLoop> last_friction_loop(std::span<const LateralPoint> run);

}  // namespace afm::physics
