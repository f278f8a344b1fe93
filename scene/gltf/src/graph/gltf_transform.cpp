// SPDX-License-Identifier: Apache-2.0
#include "graph/gltf_transform.h"

#include <fmt/core.h>

#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "gltf_error.h"

namespace afm::scene {

NodeTransform read_transform(const tinygltf::Model& model, std::size_t index) {
  const tinygltf::Node& node = model.nodes[index];
  const auto fail = [&](const char* reason) { throw GltfError(fmt::format("/nodes/{} {}", index, reason)); };
  NodeTransform transform;
  if (!node.matrix.empty()) {
    const auto& matrix = node.matrix;
    if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1) fail("has a matrix that is not affine");
    transform.matrix = glm::make_mat4(matrix.data());
  }
  if (!node.translation.empty()) transform.translation = glm::make_vec3(node.translation.data());
  if (!node.scale.empty()) transform.scale = glm::make_vec3(node.scale.data());
  if (!node.rotation.empty()) {
    const auto& rotation = node.rotation;
    transform.rotation = glm::dquat(rotation[3], rotation[0], rotation[1], rotation[2]);
    const double length = glm::length(transform.rotation);
    if (std::abs(length - 1.0) > 0.005) fail("has a rotation that is not a unit quaternion");
    transform.rotation /= length;
  }
  return transform;
}

glm::dmat4 matrix_of(const NodeTransform& transform) {
  if (transform.matrix) return *transform.matrix;
  glm::dmat4 matrix = glm::mat4_cast(transform.rotation);
  for (int i = 0; i < 3; ++i) matrix[i] *= transform.scale[i];
  matrix[3] = glm::dvec4(transform.translation, 1.0);
  return matrix;
}

glm::mat4 matrix_from(const float* numbers) {
  glm::mat4 matrix = glm::make_mat4(numbers);
  for (int column = 0; column < 4; ++column) matrix[column][3] = column == 3 ? 1.0F : 0.0F;
  return matrix;
}

}  // namespace afm::scene
