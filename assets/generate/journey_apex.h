// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "model_file.h"

// The end of the tip as the journey of scale shows it: clusters as wide as a part of their distance from the lowest
// point, then atoms. Metres.
namespace afm::generate {

// The ball's cap with its lowest point at the origin; it joins tip_sides(apex_shares()).
std::vector<Part> apex();
std::vector<double> apex_shares();

// Silicon and nitrogen, the lowest of them at height zero; those before the tip and below it, which the viewer sees.
// They sink into the ball with their distance.
std::vector<Part> apex_atoms();
double atom_shell();  // between the ball and the lowest of its atoms

}  // namespace afm::generate
