// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace afm::exhibit {

// Lines for a tip to write into a soft sample, in the sample's frame, metres of the nanoworld.
struct LinesToWrite {
  std::vector<std::vector<glm::dvec2>> lines_m;  // corners of each line in order, at least two
  double width_m = 0;                            // wanted width of the groove, at the height of the level sample
};

}  // namespace afm::exhibit
