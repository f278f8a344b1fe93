// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "scene/graph/scene.h"

namespace afm::scene {

// The node's transform at rest relative to one of its ancestors.
glm::dmat4 ancestor_from_node(const Scene& scene, NodeIndex ancestor, NodeIndex node);

bool is_below(const Scene& scene, NodeIndex ancestor, NodeIndex node);

struct Bounds {
  glm::dvec3 low{std::numeric_limits<double>::infinity()};
  glm::dvec3 high{-std::numeric_limits<double>::infinity()};
};

// Bounds of everything below `root` at rest, in root's frame.
Bounds bounds_below(const Scene& scene, NodeIndex root);

}  // namespace afm::scene
