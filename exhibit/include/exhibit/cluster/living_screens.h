// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "render/frame.h"
#include "scene/display/wall.h"

namespace afm::exhibit {

// Machines of a wall whose picture no longer changes.
struct AbsentMachines {
  std::uint64_t nodes = 0;  // one bit per node, as in cluster::FrameMessage::missing
  bool master = false;
};

// Placement of the banner on the screens that still draw, since it says whether a force is on, and which screen is
// missing: within the widest stretch of them that it crosses, or at the top of the largest one if it crosses none.
// Unchanged if no machine is absent, or all are, and for a banner that is not shown. Every machine of a wall computes
// the same.
render::PanelPlacement on_living_screens(const render::PanelPlacement& banner, const scene::Wall& wall,
                                         const AbsentMachines& absent);

}  // namespace afm::exhibit
