// SPDX-License-Identifier: Apache-2.0
#include "graph/gltf_draco.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "gltf_error.h"

// Draco's headers contain implicit conversions
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <draco/compression/mesh/mesh_edgebreaker_decoder.h>
#include <draco/compression/mesh/mesh_sequential_decoder.h>
#pragma GCC diagnostic pop

namespace afm::scene {
namespace {

using Stream = std::span<const std::uint8_t>;

// Upper limit for the contents of a stream; edgebreaker needs about one bit per triangle.
constexpr std::size_t kMostCornersPerByte = 64;
constexpr std::uint64_t kMostSeamNumbers = 64ULL << 20U;
constexpr std::uint64_t kMostAttributeBytes = 128ULL << 20U;

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

// Sizes in the header (Draco bitstream 2.2, sections 5 to 7). The decoder allocates memory for them before it checks
// the rest.
struct Announced {
  bool edgebreaker = false;
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint64_t seam_tables = 0;  // number of tables with one entry per corner
};

std::optional<Announced> read_announced(Stream stream) {
  constexpr std::size_t kHeader = 11;
  if (stream.size() < kHeader + 4 || std::string(stream.begin(), stream.begin() + 5) != "DRACO") return std::nullopt;
  const bool is_version_2_2 = stream[5] == 2 && stream[6] == 2;
  const bool is_mesh = stream[7] == 1;
  const bool has_metadata = (stream[10] & 0x80U) != 0;
  if (!is_version_2_2 || !is_mesh || has_metadata) return std::nullopt;
  Announced announced{.edgebreaker = stream[8] == 1};
  stream = stream.subspan(kHeader + (announced.edgebreaker ? 1 : 0));  // after the traversal type
  const auto first = read_varint(stream), second = read_varint(stream);
  if (!first || !second || stream.empty()) return std::nullopt;
  announced.vertices = announced.edgebreaker ? *first : *second;
  announced.triangles = announced.edgebreaker ? *second : *first;
  if (announced.edgebreaker) announced.seam_tables = stream.front();
  return announced;
}

// Decoder that checks the sizes of the attributes, which are known before their values, and limits them to the needs of
// a model. It stores each value up to three times at once.
template <class Decoder>
class BoundedDecoder : public Decoder {
 public:
  bool found_too_much() const { return found_too_much_; }

 private:
  bool DecodeAllAttributes() override {
    std::uint64_t bytes = 0;
    const draco::PointCloud& cloud = *this->point_cloud();
    for (int i = 0; i < cloud.num_attributes(); ++i) {
      const draco::PointAttribute& attribute = *cloud.attribute(i);
      const auto width = static_cast<std::uint64_t>(std::max(draco::DataTypeLength(attribute.data_type()), 4));
      const auto components = static_cast<std::uint64_t>(attribute.num_components());
      bytes += std::uint64_t{cloud.num_points()} * components * width;
    }
    found_too_much_ = bytes > kMostAttributeBytes;
    return !found_too_much_ && Decoder::DecodeAllAttributes();
  }

  bool found_too_much_ = false;
};

template <class Decoder>
void decode(Stream stream, draco::Mesh& mesh) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(stream.data()), stream.size());
  BoundedDecoder<Decoder> decoder;
  const draco::Status status = decoder.Decode(draco::DecoderOptions(), &buffer, &mesh);
  if (decoder.found_too_much()) {
    throw GltfError(fmt::format("its Draco stream announces more than {} MiB of attributes; make it smaller",
                                kMostAttributeBytes >> 20U));
  }
  if (!status.ok()) {
    throw GltfError(fmt::format("its Draco stream is corrupt ({})", status.error_msg_string().substr(0, 80)));
  }
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
    throw GltfError(fmt::format("its Draco stream does not contain {} as its accessor describes it", wanted.name));
  }
  std::vector<float> values(components * mesh.num_points());
  const bool normalize = wanted.accessor->normalized && !attribute->normalized();
  for (std::uint32_t point = 0; point < mesh.num_points(); ++point) {
    float* value = &values[components * point];
    const draco::AttributeValueIndex index = attribute->mapped_index(draco::PointIndex(point));
    if (index.value() >= attribute->size() ||
        !attribute->ConvertValue<float>(index, static_cast<std::int8_t>(components), value)) {
      throw GltfError(fmt::format("its Draco stream contains an unreadable {}", wanted.name));
    }
    for (std::size_t i = 0; i < components; ++i) {
      if (normalize) value[i] = std::max(value[i] / largest(wanted.accessor->type), -1.0F);
      if (!std::isfinite(value[i])) {
        throw GltfError(fmt::format("its Draco stream contains a {} that is not finite", wanted.name));
      }
    }
  }
  return values;
}

}  // namespace

DracoMesh decode_draco(Stream stream, std::size_t corners, const std::vector<DracoAttribute>& wanted) {
  const std::optional<Announced> announced = read_announced(stream);
  if (!announced) throw GltfError("its Draco stream is not a mesh of bitstream 2.2 without metadata");
  if (announced->triangles * 3 != corners || corners / kMostCornersPerByte > stream.size()) {
    throw GltfError(
        fmt::format("its Draco stream announces {} triangles, its accessor {} indices", announced->triangles, corners));
  }
  if (announced->vertices > corners || announced->seam_tables * corners > kMostSeamNumbers) {
    throw GltfError(fmt::format("its Draco stream announces {} vertices and {} seams for {} triangles; export it again",
                                announced->vertices, announced->seam_tables, announced->triangles));
  }
  draco::Mesh mesh;
  if (announced->edgebreaker) {
    decode<draco::MeshEdgebreakerDecoder>(stream, mesh);
  } else {
    decode<draco::MeshSequentialDecoder>(stream, mesh);
  }
  if (std::uint64_t{mesh.num_faces()} * 3 != corners) throw GltfError("its Draco stream is corrupt (it ends early)");
  DracoMesh result;
  result.indices.reserve(corners);
  for (std::uint32_t face = 0; face < mesh.num_faces(); ++face) {
    for (const draco::PointIndex& corner : mesh.face(draco::FaceIndex(face))) result.indices.push_back(corner.value());
  }
  for (const DracoAttribute& attribute : wanted) {
    result.attributes.emplace(attribute.name, read_attribute(mesh, attribute));
  }
  return result;
}

}  // namespace afm::scene
