// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/graph/scene.h"

namespace afm::render {

// New order of a primitive's vertices, and the indices into that order.
struct MeshOrder {
  std::vector<std::uint32_t> vertices;  // vertices that are used by a triangle
  std::vector<std::uint32_t> indices;
};

// Order in which triangles are drawn fast: adjacent ones in succession, so that most corners have just been shaded, and
// vertices in the order of first use. Blended primitives, and those without triangles, keep their own order.
MeshOrder drawing_order(const scene::Primitive& primitive, bool blended);

}  // namespace afm::render
