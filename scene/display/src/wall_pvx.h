// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/display/wall.h"

namespace afm::scene {

// The screens of a ParaView configuration: the corners LowerLeft, LowerRight and UpperRight of its Machine elements, in
// metres, and its EyeSeparation. The viewer is at the room's origin, as ParaView has it, or, where that is not in front
// of every screen, the first screen's width away from its middle. The error names file, line and attribute.
core::Result<Wall> load_pvx(const std::string& path);

}  // namespace afm::scene
