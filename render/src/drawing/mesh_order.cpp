// SPDX-License-Identifier: Apache-2.0
#include "drawing/mesh_order.h"

#include <meshoptimizer.h>

#include <numeric>

namespace afm::render {

MeshOrder drawing_order(const scene::Primitive& primitive, bool blended) {
  MeshOrder order;
  order.indices = primitive.indices;
  const std::size_t vertex_count = primitive.vertices.size();
  order.vertices.resize(vertex_count);
  std::iota(order.vertices.begin(), order.vertices.end(), 0U);
  if (blended || primitive.topology != scene::Topology::Triangles || order.indices.empty()) {
    return order;
  }
  meshopt_optimizeVertexCache(order.indices.data(), primitive.indices.data(), primitive.indices.size(), vertex_count);
  std::vector<std::uint32_t> new_place(vertex_count);
  const std::size_t used =
      meshopt_optimizeVertexFetchRemap(new_place.data(), order.indices.data(), order.indices.size(), vertex_count);
  order.vertices.resize(used);
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    if (new_place[vertex] < used) {
      order.vertices[new_place[vertex]] = vertex;
    }
  }
  for (std::uint32_t& index : order.indices) {
    index = new_place[index];
  }
  return order;
}

}  // namespace afm::render
