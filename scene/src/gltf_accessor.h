// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gltf_buffers.h"
#include "gltf_json.h"

namespace afm::scene {

// glTF's numbers, section 3.6.2.2.
enum class ComponentType : std::uint16_t {
  Byte = 5120,
  UnsignedByte = 5121,
  Short = 5122,
  UnsignedShort = 5123,
  UnsignedInt = 5125,
  Float = 5126
};

struct SparseValues {
  std::uint32_t count = 0;
  ComponentType index_type = ComponentType::UnsignedInt;
  std::span<const std::uint8_t> indices;
  std::span<const std::uint8_t> values;
};

// A typed view of bytes, all of whose elements lie within them.
struct Accessor {
  std::size_t count = 0;
  int components = 1;
  ComponentType type = ComponentType::Float;
  bool normalized = false;
  bool matrix = false;
  std::span<const std::uint8_t> bytes;  // empty: zeros
  std::size_t stride = 0;
  std::optional<SparseValues> sparse;
};

class GltfAccessors {
 public:
  // Throws GltfFault. `buffers` must outlive it.
  GltfAccessors(const GltfBuffers& buffers, const JsonElement& root);

  std::size_t size() const { return accessors_.size(); }
  const Accessor& operator[](std::size_t index) const { return accessors_[index]; }

  // All components of all elements; normalised integers as 0..1 or -1..1. Throws GltfFault for what is not finite.
  std::vector<float> floats(std::size_t index) const;

  // The same of unsigned integers, as they are.
  std::vector<std::uint32_t> integers(std::size_t index) const;

 private:
  std::vector<Accessor> accessors_;
};

}  // namespace afm::scene
