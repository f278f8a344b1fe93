// SPDX-License-Identifier: Apache-2.0
#include "gltf_draco.h"

#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <optional>

#include "gltf_fault.h"

// Draco's headers convert as they please
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <draco/compression/decode.h>
#pragma GCC diagnostic pop

namespace afm::scene {
namespace {

using Stream = std::span<const std::uint8_t>;

// What a stream of this many bytes can hold at best; edgebreaker needs about a bit a triangle.
constexpr std::size_t kMostCornersPerByte = 64;

std::optional<std::uint64_t> read_varint(Stream& stream) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 35 && !stream.empty(); shift += 7) {
    const std::uint8_t byte = stream.front();
    stream = stream.subspan(1);
    value |= std::uint64_t{byte & 0x7FU} << shift;
    if ((byte & 0x80U) == 0) return value;
  }
  return std::nullopt;
}

// The number of triangles that the header announces (Draco bitstream 2.2, sections 5 to 7): the decoder makes room for
// as many before it looks at the rest.
std::optional<std::uint64_t> announced_triangles(Stream stream) {
  constexpr std::size_t kHeader = 11;
  if (stream.size() < kHeader + 2 || std::string(stream.begin(), stream.begin() + 5) != "DRACO") return std::nullopt;
  const bool is_version_2_2 = stream[5] == 2 && stream[6] == 2;
  const bool is_mesh = stream[7] == 1;
  const bool has_metadata = (stream[10] & 0x80U) != 0;
  if (!is_version_2_2 || !is_mesh || has_metadata) return std::nullopt;
  const bool edgebreaker = stream[8] == 1;
  stream = stream.subspan(kHeader);
  if (edgebreaker) {
    stream = stream.subspan(1);  // the kind of traversal
    if (!read_varint(stream)) return std::nullopt;
  }
  return read_varint(stream);
}

float largest(int component_type) {
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return 127.0F;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 255.0F;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return 32767.0F;
    default:
      return 65535.0F;
  }
}

std::vector<float> read_attribute(const draco::Mesh& mesh, const DracoAttribute& wanted) {
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(wanted.id);
  const auto components = static_cast<std::size_t>(wanted.accessor->components);
  if (attribute == nullptr || attribute->num_components() != wanted.accessor->components ||
      mesh.num_points() != wanted.accessor->count) {
    throw GltfFault(fmt::format("its Draco stream does not hold {} as its accessor describes it", wanted.name));
  }
  std::vector<float> values(components * mesh.num_points());
  const bool normalize = wanted.accessor->normalized && !attribute->normalized();
  for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
    float* value = &values[components * point];
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(point));
    if (index.value() >= attribute->size() ||
        !attribute->ConvertValue<float>(index, static_cast<std::int8_t>(components), value)) {
      throw GltfFault(fmt::format("its Draco stream holds a {} that cannot be read", wanted.name));
    }
    for (std::size_t i = 0; i < components; ++i) {
      if (normalize) value[i] = std::max(value[i] / largest(wanted.accessor->type), -1.0F);
      if (!std::isfinite(value[i])) {
        throw GltfFault(fmt::format("its Draco stream holds a {} that is not a finite number", wanted.name));
      }
    }
  }
  return values;
}

}  // namespace

DracoMesh decode_draco(Stream stream, std::size_t corners, const std::vector<DracoAttribute>& wanted) {
  const std::optional<std::uint64_t> triangles = announced_triangles(stream);
  if (!triangles) throw GltfFault("its Draco stream is no mesh of bitstream 2.2 without metadata");
  if (*triangles * 3 != corners || corners / kMostCornersPerByte > stream.size()) {
    throw GltfFault(
        fmt::format("its Draco stream announces {} triangles, its accessor {} indices", *triangles, corners));
  }
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  draco::Decoder decoder;
  auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) {
    throw GltfFault(fmt::format("its Draco stream is broken ({})", decoded.status().error_msg_string().substr(0, 80)));
  }
  const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
  if (std::uint64_t{mesh->num_faces()} * 3 != corners) throw GltfFault("its Draco stream is broken (it ends early)");
  DracoMesh result;
  result.indices.reserve(corners);
  for (std::uint32_t face = 0; face < mesh->num_faces(); ++face) {
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(face))) result.indices.push_back(corner.value());
  }
  for (const DracoAttribute& attribute : wanted) {
    result.attributes.emplace(attribute.name, read_attribute(*mesh, attribute));
  }
  return result;
}

}  // namespace afm::scene
