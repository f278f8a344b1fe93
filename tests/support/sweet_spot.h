// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "exhibit/frame/wall_pictures.h"
#include "scene/display/wall.h"

namespace afm::support {

// Eyes of the wall's first viewer at the sweet spot, for the first screen.
inline std::array<scene::EyeView, 2> eyes_at_sweet_spot(const scene::Wall& wall) {
  const scene::Viewer& viewer = wall.viewers.front();
  return exhibit::eyes_before(wall.screens.front(), viewer.sweet_spot, viewer.ipd_m).value();
}

}  // namespace afm::support
