// SPDX-License-Identifier: Apache-2.0
#include "gltf_transform.h"

#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

namespace afm::scene {

NodeTransform read_transform(const JsonElement& node) {
  constexpr JsonElement::Range kFinite{-1e30, 1e30};
  NodeTransform transform;
  std::array<double, 16> matrix{};
  std::array<double, 4> rotation{};
  std::array<double, 3> vector{};
  if (node.numbers("matrix", matrix, kFinite)) {
    if (matrix[3] != 0 || matrix[7] != 0 || matrix[11] != 0 || matrix[15] != 1)
      node.fail("has a matrix that is not affine");
    if (node.has("translation") || node.has("rotation") || node.has("scale")) {
      node.fail("has a matrix beside a translation, rotation or scale");
    }
    transform.matrix = glm::make_mat4(matrix.data());
  }
  if (node.numbers("translation", vector, kFinite)) transform.translation = glm::make_vec3(vector.data());
  if (node.numbers("scale", vector, kFinite)) transform.scale = glm::make_vec3(vector.data());
  if (node.numbers("rotation", rotation, {-1.01, 1.01})) {
    transform.rotation = glm::dquat(rotation[3], rotation[0], rotation[1], rotation[2]);
    const double length = glm::length(transform.rotation);
    if (std::abs(length - 1.0) > 0.005) node.fail("has a rotation that is no unit quaternion");
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
