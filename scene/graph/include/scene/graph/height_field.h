// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scene/graph/scene.h"
#include "scene/shared/shared_blocks.h"

namespace afm::scene {

// Heights of everything drawn below `root`, along +z of root's frame. Empty if nothing is drawn there, or nothing with
// an extent along x and y.
//
// If the first primitive of root's own mesh is a square grid as in SharedHeightField, and small enough, its vertices
// are the field, bit for bit. Any other geometry is sampled from above, on a grid of the largest size: the highest
// triangle counts and, outside all triangles, the lowest vertex. Allocates.
std::optional<SharedHeightField> height_field_below(const Scene& scene, NodeIndex root);

}  // namespace afm::scene
