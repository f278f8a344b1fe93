// SPDX-License-Identifier: Apache-2.0
#include "gltf_accessor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "gltf_error.h"

namespace afm::scene {
namespace {

std::size_t size_of(int component_type) {
  return static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(component_type)));
}

// Columns of matrices are aligned to four bytes.
std::size_t element_size(const Accessor& accessor) {
  const std::size_t component = size_of(accessor.type);
  if (!accessor.matrix) return component * static_cast<std::size_t>(accessor.components);
  const auto rows = static_cast<std::size_t>(std::lround(std::sqrt(accessor.components)));
  return rows * ((rows * component + 3) / 4 * 4);
}

class AccessorReader {
 public:
  AccessorReader(std::size_t index, const tinygltf::Accessor& source, const std::vector<BufferView>& views)
      : index_(index), source_(source), views_(views) {}

  Accessor read() {
    accessor_.type = source_.componentType;
    accessor_.components = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(source_.type));
    accessor_.matrix =
        source_.type == TINYGLTF_TYPE_MAT2 || source_.type == TINYGLTF_TYPE_MAT3 || source_.type == TINYGLTF_TYPE_MAT4;
    accessor_.normalized = source_.normalized;
    if (accessor_.normalized && size_of(accessor_.type) == 4) fail("normalises a type other than 8 or 16-bit integers");
    accessor_.count = source_.count;
    if (accessor_.count == 0) return accessor_;  // empty accessor, refused where it is used
    const std::size_t size = element_size(accessor_);
    accessor_.stride = size;
    if (source_.bufferView >= 0) {
      const BufferView& view = views_[static_cast<std::size_t>(source_.bufferView)];
      if (view.stride != 0) accessor_.stride = view.stride;
      if (accessor_.stride < size) fail("has elements that overlap");
      accessor_.bytes = elements(view, source_.byteOffset, accessor_.count, accessor_.stride, size, accessor_.type);
    } else if (source_.byteOffset != 0) {
      fail("has a byteOffset but no bufferView");
    }
    if (source_.sparse.isSparse) read_sparse(size);
    return accessor_;
  }

 private:
  [[noreturn]] void fail(const char* reason) const { throw GltfError(fmt::format("/accessors/{} {}", index_, reason)); }

  // `count` elements from `offset`; the last one ends within the view.
  std::span<const std::uint8_t> elements(const BufferView& view, std::uint64_t offset, std::uint64_t count,
                                         std::size_t stride, std::size_t size, int type) const {
    const std::uint64_t length = view.bytes.size();
    if (offset > length || (count - 1) * stride + size > length - offset) {
      fail("reaches past the end of its buffer view");
    }
    if (offset % size_of(type) != 0) fail("has a byteOffset that is not a multiple of its component size");
    return view.bytes.subspan(offset, (count - 1) * stride + size);
  }

  void read_sparse(std::size_t size) {
    const auto& indices = source_.sparse.indices;
    const auto& values = source_.sparse.values;
    SparseValues& sparse = accessor_.sparse.emplace();
    sparse.count = static_cast<std::size_t>(source_.sparse.count);
    if (sparse.count > accessor_.count) fail("has more sparse elements than elements");
    sparse.index_type = indices.componentType;
    const std::size_t width = size_of(sparse.index_type);
    sparse.indices =
        elements(views_[static_cast<std::size_t>(indices.bufferView)], static_cast<std::uint64_t>(indices.byteOffset),
                 sparse.count, width, width, sparse.index_type);
    sparse.values = elements(views_[static_cast<std::size_t>(values.bufferView)],
                             static_cast<std::uint64_t>(values.byteOffset), sparse.count, size, size, accessor_.type);
  }

  std::size_t index_;
  const tinygltf::Accessor& source_;
  const std::vector<BufferView>& views_;
  Accessor accessor_;
};

// Copies the bytes: glTF data are little-endian and may be unaligned in memory.
template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// glTF 2.0, section 3.6.2.2: c / 255, max(c / 127, -1) and so on.
float number_at(const std::uint8_t* bytes, int type, bool normalized) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE: {
      const auto value = static_cast<float>(load<std::int8_t>(bytes));
      return normalized ? std::max(value / 127.0F, -1.0F) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return static_cast<float>(*bytes) / (normalized ? 255.0F : 1.0F);
    case TINYGLTF_COMPONENT_TYPE_SHORT: {
      const auto value = static_cast<float>(load<std::int16_t>(bytes));
      return normalized ? std::max(value / 32767.0F, -1.0F) : value;
    }
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return static_cast<float>(load<std::uint16_t>(bytes)) / (normalized ? 65535.0F : 1.0F);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
      return static_cast<float>(load<std::uint32_t>(bytes));
    default:
      return load<float>(bytes);
  }
}

std::uint32_t integer(const std::uint8_t* bytes, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *bytes;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

// Calls put(element, bytes of the element) for all elements, the sparse ones last.
template <class Put>
void for_each_element(const Accessor& accessor, int index, Put put) {
  for (std::size_t i = 0; i < accessor.count && !accessor.bytes.empty(); ++i) {
    put(i, accessor.bytes.data() + i * accessor.stride);
  }
  if (!accessor.sparse) return;
  const SparseValues& sparse = *accessor.sparse;
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < sparse.count; ++i) {
    const std::uint32_t element = integer(sparse.indices.data() + i * size_of(sparse.index_type), sparse.index_type);
    if (element < next || element >= accessor.count) {
      throw GltfError(fmt::format("/accessors/{}/sparse has indices that are out of range or not increasing", index));
    }
    next = std::uint64_t{element} + 1;
    put(element, sparse.values.data() + i * element_size(accessor));
  }
}

}  // namespace

GltfAccessors::GltfAccessors(const GltfBuffers& buffers, const tinygltf::Model& model) {
  for (std::size_t i = 0; i < model.accessors.size(); ++i) {
    accessors_.push_back(AccessorReader(i, model.accessors[i], buffers.views()).read());
  }
}

const Accessor& GltfAccessors::operator[](int index) const {
  const Accessor& accessor = accessors_[static_cast<std::size_t>(index)];
  if (accessor.count == 0)
    throw GltfError(fmt::format("/accessors/{}/count is 0, but a part of the model uses it", index));
  return accessor;
}

std::vector<float> GltfAccessors::floats(int index) const {
  const Accessor& accessor = (*this)[index];
  const auto components = static_cast<std::size_t>(accessor.components);
  const std::size_t width = size_of(accessor.type);
  std::vector<float> values(accessor.count * components, 0.0F);
  for_each_element(accessor, index, [&](std::size_t element, const std::uint8_t* bytes) {
    for (std::size_t i = 0; i < components; ++i) {
      const float value = number_at(bytes + i * width, accessor.type, accessor.normalized);
      if (!std::isfinite(value))
        throw GltfError(fmt::format("/accessors/{} contains a value that is not finite", index));
      values[element * components + i] = value;
    }
  });
  return values;
}

std::vector<std::uint32_t> GltfAccessors::integers(int index) const {
  const Accessor& accessor = (*this)[index];
  const auto components = static_cast<std::size_t>(accessor.components);
  const std::size_t width = size_of(accessor.type);
  std::vector<std::uint32_t> values(accessor.count * components, 0U);
  for_each_element(accessor, index, [&](std::size_t element, const std::uint8_t* bytes) {
    for (std::size_t i = 0; i < components; ++i)
      values[element * components + i] = integer(bytes + i * width, accessor.type);
  });
  return values;
}

}  // namespace afm::scene
