// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "scene/graph/scene.h"

namespace afm::exhibit {

// The space that a vibrating lever sweeps: its outline, between its shapes with the end at -1 and at 1 along z. x and y
// are those of the lever's mesh, whose upper side looks along +z; `length` is from its clamp, at x = 0, to the tip's
// axis. All of `material`.
scene::Mesh swing_band(const scene::Mesh& lever, double length, std::uint32_t material);

}  // namespace afm::exhibit
