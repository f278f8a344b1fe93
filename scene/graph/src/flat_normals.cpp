// SPDX-License-Identifier: Apache-2.0
#include "scene/graph/flat_normals.h"

#include <glm/geometric.hpp>

namespace afm::scene {
namespace {

template <class T>
void gather(std::vector<T>& stream, const std::vector<std::uint32_t>& from) {
  if (stream.empty()) return;
  std::vector<T> gathered;
  gathered.reserve(from.size());
  for (const std::uint32_t index : from) gathered.push_back(stream[index]);
  stream = std::move(gathered);
}

}  // namespace

void separate_corners(Primitive& primitive) {
  gather(primitive.vertices, primitive.indices);
  gather(primitive.texture_coordinates, primitive.indices);
  gather(primitive.tangents, primitive.indices);
  gather(primitive.influences, primitive.indices);
  gather(primitive.more_influences, primitive.indices);
  for (MorphTarget& target : primitive.targets) {
    gather(target.positions, primitive.indices);
    gather(target.normals, primitive.indices);
    gather(target.tangents, primitive.indices);
  }
  for (std::size_t i = 0; i < primitive.indices.size(); ++i) primitive.indices[i] = static_cast<std::uint32_t>(i);
}

void set_flat_normals(Primitive& primitive) {
  for (std::size_t i = 0; i + 2 < primitive.vertices.size(); i += 3) {
    const glm::dvec3 a(primitive.vertices[i].position);
    const glm::dvec3 normal = glm::cross(glm::dvec3(primitive.vertices[i + 1].position) - a,
                                         glm::dvec3(primitive.vertices[i + 2].position) - a);
    const double length = glm::length(normal);
    for (std::size_t corner = i; corner < i + 3; ++corner) {
      primitive.vertices[corner].normal = length > 0 ? glm::vec3(normal / length) : glm::vec3(0, 0, 1);
    }
  }
}

}  // namespace afm::scene
