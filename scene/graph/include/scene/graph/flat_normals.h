// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/graph/scene.h"

namespace afm::scene {

// Splits shared corners, so that every triangle can have its own normal.
void separate_corners(Primitive& primitive);

// Sets the normals of each triangle's three corners, which it must not share, from their positions.
void set_flat_normals(Primitive& primitive);

}  // namespace afm::scene
