// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "gltf_model.h"

namespace afm::scene {

// Transform of a node below its parent: a matrix, or its translation, rotation and scale.
struct NodeTransform {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
  std::optional<glm::dmat4> matrix{};
};

// Transform of node number `node` in the file. Throws GltfError.
NodeTransform read_transform(const tinygltf::Model& model, std::size_t node);

glm::dmat4 matrix_of(const NodeTransform& transform);

// Sixteen numbers, column by column. The last row must be 0 0 0 1, as in all matrices of skins and nodes.
glm::mat4 matrix_from(const float* numbers);

}  // namespace afm::scene
