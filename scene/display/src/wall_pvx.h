// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/display/wall.h"

namespace afm::scene {

// Reads a ParaView configuration: the corners LowerLeft, LowerRight and UpperRight of its Machine elements, in metres;
// the EyeSeparation of the first machine's viewer, or of all; and, if every machine has one and a Geometry on one
// desktop, StereoType: Left and Right of one screen become the pair of mode dual. Wall::unused lists all the rest. The
// viewer is at the room's origin, as in ParaView, or, if that is not in front of every screen, in front of the centre
// of the first screen at a distance of its width. The error names file, line and attribute.
core::Result<Wall> load_pvx(const std::string& path);

}  // namespace afm::scene
