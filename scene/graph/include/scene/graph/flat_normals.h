// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/graph/scene.h"

namespace afm::scene {

// Splits shared corners, so that every triangle can have its own normal.
void separate_corners(Primitive& primitive);

// Sets the normal of each triangle's three corners, which are its own, from where they stand.
void set_flat_normals(Primitive& primitive);

}  // namespace afm::scene
