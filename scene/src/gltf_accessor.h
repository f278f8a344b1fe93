// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <glm/vec4.hpp>

namespace afm::scene {

// Reads elements of an accessor of `model` whose view, range and component type gltf_validation.h has checked.
class AccessorReader {
 public:
  AccessorReader(const tinygltf::Model& model, int accessor);

  std::size_t count() const { return count_; }

  // As floats, integers normalised to 0..1; components that the accessor lacks are those of `missing`.
  glm::vec4 floats(std::size_t element, glm::vec4 missing = glm::vec4(0.0F)) const;

  // The scalar as it is: a vertex index.
  std::uint32_t index(std::size_t element) const;

 private:
  const unsigned char* data_;
  std::size_t count_;
  std::size_t stride_;
  int component_type_;
  int components_;
};

}  // namespace afm::scene
