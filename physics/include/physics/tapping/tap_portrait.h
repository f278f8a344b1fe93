// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "physics/tapping/averaged_flow.h"
#include "physics/units.h"

namespace afm::physics {

// A swing in the plane of u = A cos(phi) and v = A sin(phi).
struct SwingPoint {
  Length u, v;
};

// The swings at one height of the base, as they move in that plane: the stable states, and the edge between the swings
// that end in one of them and those that end in another. The edge is made of the paths into the unstable states, two
// for each, drawn from that state outwards until A exceeds `reach`.
struct TapPortrait {
  std::vector<TapState> states;  // stable states, the smallest amplitude first
  std::vector<std::vector<SwingPoint>> edges;
};

// The states are those of AveragedFlow; the edge follows a table of it at this height, and is accurate to some 1 % of
// the free amplitude. Empty where the resting lever would touch. The same arguments give the same numbers.
// Takes milliseconds and allocates.
TapPortrait tap_portrait(const std::shared_ptr<const TapSurface>& surface, const DrivenLever& lever, Length z,
                         Length reach);

}  // namespace afm::physics
