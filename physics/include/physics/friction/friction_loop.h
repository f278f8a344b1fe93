// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "physics/friction/sideways.h"
#include "physics/units.h"

namespace afm::physics {

// The lateral force on the tip's holder, positive where it is pulled back along -x, at the holder's place x: a point of
// a friction loop.
struct LateralPoint {
  Length place;
  Force force;
};

// A place of the tip's holder on the sample, and the lateral force on the tip there.
struct SidewaysPoint {
  Sideways<Length> place;
  Sideways<Force> force;
};

// The same along the line through the origin on which the places spread most, which leads to +x.
std::vector<LateralPoint> along_main_line(std::span<const SidewaysPoint> points);

// What a friction loop shows. Forces and places as in LateralPoint.
struct FrictionLoop {
  Force half_width;   // half of the forward stroke's mean less the backward one's: the friction
  Force offset;       // half of their sum: what does not change its sign with the direction, a slope or a crosstalk
  Stiffness slope;    // dF/dx of the tip that sticks, after a turn
  Energy dissipated;  // by a cycle, between its turning points
  std::size_t begin = 0, turn = 0, end = 0;  // of the run: the points where the cycle begins, turns and ends
};

// The last whole cycle of a run over the sample there and back, in the order of time: two strokes of opposite
// directions, each longer than the way on which the tip sticks after its turn; the stroke that is under way counts as
// soon as it is so long. That way is left out of the means, at both ends. None where there is no such cycle, or no
// friction in it.
std::optional<FrictionLoop> last_friction_loop(std::span<const LateralPoint> run);

}  // namespace afm::physics
