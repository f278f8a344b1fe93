// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model_file.h"

// Parts common to the probe and the journey of scale. Metres.
namespace afm::generate {

// Cantilever along +x from its clamp at the origin, with its underside at z = 0; the tip is at x = lever_tip_x().
std::vector<Part> cantilever();
double lever_tip_x();
double lever_thickness();  // thickness as drawn

// Tip with its lowest point at the origin: the pyramid's faces and its edges, whose stations from one face to the next
// are `shares`.
Surface tip_sides(const std::vector<double>& shares);
// Normal on the ball's cap between the faces, at shares 0 to 1 along two of its edges; 0.5, 0.5 is its lowest point.
V3 cap_normal(double u, double v);
double tip_length();  // from the apex to the base
double tip_radius();  // radius of the ball

// Halvings of the quarters around an atom, and of the arc from its pole to its rim. An atom that is seen from the side
// has the outline of that arc.
struct Roundness {
  int around, rings;
};

// The visible part of a ball among others, more than half of it, on the side given by `facing`.
void add_atom(Surface& surface, V3 center, double radius, Facing facing, V3 color, Roundness roundness);

}  // namespace afm::generate
