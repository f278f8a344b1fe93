// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model_file.h"

// Parts common to the probe and the journey of scale. Metres.
namespace afm::generate {

// Along +x from its clamp at the origin, its underside at z = 0; what the tip hangs on is at x = lever_tip_x().
std::vector<Part> cantilever();
double lever_tip_x();
double lever_thickness();  // as it is drawn

// The tip with its lowest point at the origin: the pyramid's faces and edges, and the ball's cap, finest at the origin.
Surface tip_sides();
Surface tip_apex();
double tip_length();  // from the apex to the base
double tip_radius();  // radius of the ball

// The part of a ball that shows among others, more than half of it, on the side that `facing` says.
// 4 x 2^halvings points around, in two rings at least.
void add_atom(Surface& surface, V3 center, double radius, Facing facing, V3 color, int halvings);

}  // namespace afm::generate
