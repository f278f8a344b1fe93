// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/graph/scene.h"

namespace afm::exhibit {

// The space swept by a vibrating lever: its outline, between its shapes with the end at -1 and at 1 along z. x and y
// are the axes of the lever's mesh, whose upper side faces +z; `length` is the distance from its clamp, at x = 0, to
// the tip's axis. The whole mesh has `material`.
scene::Mesh swing_band(const scene::Mesh& lever, double length, std::uint32_t material);

}  // namespace afm::exhibit
