// SPDX-License-Identifier: Apache-2.0
#include "scene/graph/subtree.h"

#include <glm/common.hpp>
#include <optional>

namespace afm::scene {

using glm::dmat4;
using glm::dvec3;

dmat4 ancestor_from_node(const Scene& scene, NodeIndex ancestor, NodeIndex node) {
  dmat4 result(1.0);
  for (std::optional<NodeIndex> n = node; n && *n != ancestor; n = scene.nodes[*n].parent) {
    result = scene.nodes[*n].parent_from_node * result;
  }
  return result;
}

bool is_below(const Scene& scene, NodeIndex ancestor, NodeIndex node) {
  for (std::optional<NodeIndex> n = node; n; n = scene.nodes[*n].parent) {
    if (*n == ancestor) return true;
  }
  return false;
}

Bounds bounds_below(const Scene& scene, NodeIndex root) {
  Bounds bounds;
  for (NodeIndex i = 0; i < scene.nodes.size(); ++i) {
    if (!scene.nodes[i].mesh || !is_below(scene, root, i)) continue;
    const dmat4 root_from_node = ancestor_from_node(scene, root, i);
    for (const Primitive& primitive : scene.meshes[*scene.nodes[i].mesh].primitives) {
      for (const Vertex& vertex : primitive.vertices) {
        const dvec3 p(root_from_node * glm::dvec4(dvec3(vertex.position), 1.0));
        bounds.low = glm::min(bounds.low, p);
        bounds.high = glm::max(bounds.high, p);
      }
    }
  }
  return bounds;
}

}  // namespace afm::scene
