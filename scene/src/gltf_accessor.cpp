// SPDX-License-Identifier: Apache-2.0
#include "gltf_accessor.h"

#include <algorithm>
#include <cstring>

namespace afm::scene {
namespace {

// glTF is little-endian and its data need not be aligned.
template <class T>
T load(const unsigned char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

}  // namespace

AccessorReader::AccessorReader(const tinygltf::Model& model, int accessor) {
  const tinygltf::Accessor& source = model.accessors[static_cast<std::size_t>(accessor)];
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(source.bufferView)];
  data_ = model.buffers[static_cast<std::size_t>(view.buffer)].data.data() + view.byteOffset + source.byteOffset;
  count_ = source.count;
  component_type_ = source.componentType;
  components_ = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(source.type));
  const int element = components_ * tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type_));
  stride_ = view.byteStride != 0 ? view.byteStride : static_cast<std::size_t>(element);
}

glm::vec4 AccessorReader::floats(std::size_t element, glm::vec4 missing) const {
  const unsigned char* bytes = data_ + element * stride_;
  for (int i = 0; i < std::min(components_, 4); ++i) {
    const auto offset = static_cast<std::size_t>(i);
    switch (component_type_) {
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        missing[i] = static_cast<float>(bytes[offset]) / 255.0F;
        break;
      case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        missing[i] = static_cast<float>(load<std::uint16_t>(bytes + 2 * offset)) / 65535.0F;
        break;
      default:
        missing[i] = load<float>(bytes + 4 * offset);
        break;
    }
  }
  return missing;
}

std::uint32_t AccessorReader::index(std::size_t element) const {
  const unsigned char* bytes = data_ + element * stride_;
  switch (component_type_) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *bytes;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

}  // namespace afm::scene
