// SPDX-License-Identifier: Apache-2.0
#include "gltf_accessor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "gltf_fault.h"

namespace afm::scene {
namespace {

// An accessor without a view is all zeros, so that a small file can ask for much.
constexpr std::uint64_t kMostElements = 24'000'000;

std::size_t size_of(ComponentType type) {
  switch (type) {
    case ComponentType::Byte:
    case ComponentType::UnsignedByte:
      return 1;
    case ComponentType::Short:
    case ComponentType::UnsignedShort:
      return 2;
    default:
      return 4;
  }
}

ComponentType component_type(const JsonElement& element) {
  const std::uint64_t number = element.required_size("componentType", 65535);
  if (number < 5120 || number > 5126 || number == 5124) element.fail("has a componentType that glTF does not know");
  return static_cast<ComponentType>(number);
}

void read_type(const JsonElement& element, Accessor& accessor) {
  const std::string type = element.required_text("type");
  constexpr std::pair<const char*, int> kTypes[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                                                    {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
  const auto* found =
      std::find_if(std::begin(kTypes), std::end(kTypes), [&](const auto& t) { return t.first == type; });
  if (found == std::end(kTypes)) element.fail("has a type that glTF does not know");
  accessor.components = found->second;
  accessor.matrix = type[0] == 'M';
}

// Columns of matrices begin at multiples of four bytes.
std::size_t element_size(const Accessor& accessor) {
  const std::size_t component = size_of(accessor.type);
  if (!accessor.matrix) return component * static_cast<std::size_t>(accessor.components);
  const auto rows = static_cast<std::size_t>(std::lround(std::sqrt(accessor.components)));
  return rows * ((rows * component + 3) / 4 * 4);
}

// `count` elements from `offset` on, the last of which ends within the view.
std::span<const std::uint8_t> elements(const JsonElement& element, const BufferView& view, std::uint64_t count,
                                       std::size_t stride, std::size_t size, std::size_t component) {
  const std::uint64_t offset = element.size("byteOffset", 0, kLargestGltfBytes);
  const std::uint64_t length = view.bytes.size();
  if (offset > length || (count - 1) * stride + size > length - offset) {
    element.fail("reaches past the end of its buffer view");
  }
  if (offset % component != 0) element.fail("has a byteOffset that is not a multiple of its components' size");
  return view.bytes.subspan(offset, (count - 1) * stride + size);
}

const BufferView& view_of(const JsonElement& element, const GltfBuffers& buffers) {
  return buffers.views()[element.required_index("bufferView", buffers.views().size())];
}

SparseValues read_sparse(const JsonElement& element, const Accessor& accessor, const GltfBuffers& buffers) {
  SparseValues sparse;
  sparse.count = static_cast<std::uint32_t>(element.required_size("count", accessor.count));
  if (sparse.count == 0) element.fail("has no element");
  const JsonElement indices = element.required_object("indices");
  const JsonElement values = element.required_object("values");
  sparse.index_type = component_type(indices);
  const std::size_t width = size_of(sparse.index_type);
  if (sparse.index_type != ComponentType::UnsignedByte && sparse.index_type != ComponentType::UnsignedShort &&
      sparse.index_type != ComponentType::UnsignedInt) {
    indices.fail("has a componentType that is no unsigned integer");
  }
  sparse.indices = elements(indices, view_of(indices, buffers), sparse.count, width, width, width);
  const std::size_t size = element_size(accessor);
  sparse.values = elements(values, view_of(values, buffers), sparse.count, size, size, size_of(accessor.type));
  return sparse;
}

Accessor read_accessor(const JsonElement& element, const GltfBuffers& buffers) {
  Accessor accessor;
  accessor.type = component_type(element);
  read_type(element, accessor);
  accessor.normalized = element.flag("normalized", false);
  if (accessor.normalized && size_of(accessor.type) == 4) element.fail("normalises what is no 8 or 16-bit integer");
  accessor.count = element.required_size("count", kMostElements);
  if (accessor.count == 0) element.fail("has no element");
  const std::size_t size = element_size(accessor);
  accessor.stride = size;
  if (element.has("bufferView")) {
    const BufferView& view = view_of(element, buffers);
    if (view.stride != 0) accessor.stride = view.stride;
    if (accessor.stride < size) element.fail("has elements that overlap");
    accessor.bytes = elements(element, view, accessor.count, accessor.stride, size, size_of(accessor.type));
  } else if (element.has("byteOffset")) {
    element.fail("has a byteOffset but no bufferView");
  }
  if (const auto sparse = element.object("sparse")) accessor.sparse = read_sparse(*sparse, accessor, buffers);
  return accessor;
}

// glTF is little-endian and its data need not be aligned in memory.
template <class T>
T load(const std::uint8_t* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

// glTF 2.0, section 3.6.2.2: c / 255, max(c / 127, -1) and so on.
float number(const std::uint8_t* bytes, ComponentType type, bool normalized) {
  switch (type) {
    case ComponentType::Byte: {
      const auto value = static_cast<float>(load<std::int8_t>(bytes));
      return normalized ? std::max(value / 127.0F, -1.0F) : value;
    }
    case ComponentType::UnsignedByte:
      return static_cast<float>(*bytes) / (normalized ? 255.0F : 1.0F);
    case ComponentType::Short: {
      const auto value = static_cast<float>(load<std::int16_t>(bytes));
      return normalized ? std::max(value / 32767.0F, -1.0F) : value;
    }
    case ComponentType::UnsignedShort:
      return static_cast<float>(load<std::uint16_t>(bytes)) / (normalized ? 65535.0F : 1.0F);
    case ComponentType::UnsignedInt:
      return static_cast<float>(load<std::uint32_t>(bytes));
    case ComponentType::Float:
      break;
  }
  return load<float>(bytes);
}

std::uint32_t integer(const std::uint8_t* bytes, ComponentType type) {
  switch (type) {
    case ComponentType::UnsignedByte:
      return *bytes;
    case ComponentType::UnsignedShort:
      return load<std::uint16_t>(bytes);
    default:
      return load<std::uint32_t>(bytes);
  }
}

// Calls put(element, bytes of the element) for all of them, the sparse ones last.
template <class Put>
void for_each_element(const Accessor& accessor, std::size_t index, Put put) {
  for (std::size_t i = 0; i < accessor.count && !accessor.bytes.empty(); ++i) {
    put(i, accessor.bytes.data() + i * accessor.stride);
  }
  if (!accessor.sparse) return;
  const SparseValues& sparse = *accessor.sparse;
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < sparse.count; ++i) {
    const std::uint32_t element = integer(sparse.indices.data() + i * size_of(sparse.index_type), sparse.index_type);
    if (element < next || element >= accessor.count) {
      throw GltfFault(fmt::format("/accessors/{}/sparse has indices that do not rise or are out of range", index));
    }
    next = std::uint64_t{element} + 1;
    put(element, sparse.values.data() + i * element_size(accessor));
  }
}

}  // namespace

GltfAccessors::GltfAccessors(const GltfBuffers& buffers, const JsonElement& root) {
  for (const JsonElement& element : root.objects("accessors")) accessors_.push_back(read_accessor(element, buffers));
}

std::vector<float> GltfAccessors::floats(std::size_t index) const {
  const Accessor& accessor = accessors_[index];
  const auto components = static_cast<std::size_t>(accessor.components);
  const std::size_t width = size_of(accessor.type);
  std::vector<float> values(accessor.count * components, 0.0F);
  for_each_element(accessor, index, [&](std::size_t element, const std::uint8_t* bytes) {
    for (std::size_t i = 0; i < components; ++i) {
      const float value = number(bytes + i * width, accessor.type, accessor.normalized);
      if (!std::isfinite(value)) throw GltfFault(fmt::format("/accessors/{} holds what is not a finite number", index));
      values[element * components + i] = value;
    }
  });
  return values;
}

std::vector<std::uint32_t> GltfAccessors::integers(std::size_t index) const {
  const Accessor& accessor = accessors_[index];
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
