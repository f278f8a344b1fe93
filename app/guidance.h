// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/shared_blocks.h"

namespace afm::app {

// What the next step of the procedure is, in one short line, from what has really happened to the tip. `ascending`: the
// hand is on its way up. `cycles`: how often the tip has let go of this material.
std::string guidance(const scene::TipState& tip, bool ascending, int cycles);

}  // namespace afm::app
