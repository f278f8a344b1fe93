// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/display/wall.h"

namespace afm::scene {

// Adds a line for two screens at one place, for a screen or a machine without an output, and for a screen that only one
// eye sees.
void doubt_coverage(const Wall& wall, std::vector<std::string>& doubts);

}  // namespace afm::scene
