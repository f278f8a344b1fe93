// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gltf_buffers.h"

namespace afm::scene {

// Elements that replace some of an accessor's own.
struct SparseValues {
  std::size_t count = 0;
  int index_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  std::span<const std::uint8_t> indices;
  std::span<const std::uint8_t> values;
};

// Typed view of bytes; all of its elements lie within them.
struct Accessor {
  std::size_t count = 0;
  int components = 1;
  int type = TINYGLTF_COMPONENT_TYPE_FLOAT;  // type of a component
  bool normalized = false;
  bool matrix = false;
  std::span<const std::uint8_t> bytes;  // elements in order; empty: all zeros
  std::size_t stride = 0;
  std::optional<SparseValues> sparse;

  bool is_float() const { return type == TINYGLTF_COMPONENT_TYPE_FLOAT; }
};

class GltfAccessors {
 public:
  // Throws GltfError. `buffers` must outlive it.
  GltfAccessors(const GltfBuffers& buffers, const tinygltf::Model& model);

  // `index` is the accessor's number in the file. Throws GltfError for one without elements.
  const Accessor& operator[](int index) const;

  // All components of all elements; normalised integers as 0..1 or -1..1. Throws GltfError for numbers that are not
  // finite.
  std::vector<float> floats(int index) const;

  // Same for unsigned integers, unchanged.
  std::vector<std::uint32_t> integers(int index) const;

 private:
  std::vector<Accessor> accessors_;
};

}  // namespace afm::scene
