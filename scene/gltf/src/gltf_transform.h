// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "gltf_model.h"

namespace afm::scene {

// A node's place below its parent: a matrix, or the three that make one.
struct NodeTransform {
  glm::dvec3 translation{0.0};
  glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
  glm::dvec3 scale{1.0};
  std::optional<glm::dmat4> matrix{};
};

// Of the file's node of this number. Throws GltfError.
NodeTransform read_transform(const tinygltf::Model& model, std::size_t node);

glm::dmat4 matrix_of(const NodeTransform& transform);

// Sixteen numbers, column by column, whose last row must be 0 0 0 1: skins and nodes know nothing else.
glm::mat4 matrix_from(const float* numbers);

}  // namespace afm::scene
