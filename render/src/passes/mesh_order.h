// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/graph/scene.h"

namespace afm::render {

// New order of a primitive's vertices, and the indices into that order.
struct MeshOrder {
  std::vector<std::uint32_t> vertices;  // the primitive's, without those that no triangle uses
  std::vector<std::uint32_t> indices;
};

// The order in which triangles are drawn fast: neighbours one after the other, so that most corners have just been
// shaded, and vertices as they are first used. What blends, and what is no triangles, keeps its own order.
MeshOrder drawing_order(const scene::Primitive& primitive, bool blended);

}  // namespace afm::render
