// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scene/graph/scene.h"
#include "scene/shared/shared_blocks.h"

namespace afm::scene {

// The heights of what is drawn below `root`, along +z of root's frame. Empty if nothing is drawn there, or nothing that
// has an extent along x and y.
//
// Where the first primitive of root's own mesh is a square grid as SharedHeightField describes it, and small enough,
// its vertices are the field, bit for bit. Anything else is looked at from above, on a grid of the most points that a
// field holds: the highest triangle counts, and beside all of them the lowest vertex. Allocates.
std::optional<SharedHeightField> height_field_below(const Scene& scene, NodeIndex root);

}  // namespace afm::scene
