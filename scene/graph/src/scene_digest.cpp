// SPDX-License-Identifier: Apache-2.0
#include <bit>
#include <cstring>

#include "core/fnv1a.h"
#include "scene/graph/scene.h"

namespace afm::scene {
namespace {

// Placeholder for a value of any type, to count the members of a struct.
struct AnyFieldValue {
  template <class T>
  operator T() const {
    return {};
  }
};
template <class T, class... Values>
consteval std::size_t count_fields() {
  if constexpr (requires { T{Values{}..., AnyFieldValue{}}; }) {
    return count_fields<T, Values..., AnyFieldValue>();
  } else {
    return sizeof...(Values);
  }
}
static_assert(std::tuple_size_v<decltype(kPbrFields)> == count_fields<PbrMaterial>(), "a field has no row");

// 64-bit FNV-1a (Fowler, Noll, Vo; draft-eastlake-fnv, section 5) over values in a fixed order and byte order.
class Digest {
 public:
  std::uint64_t value() const { return hash_.value(); }

  void add(std::uint64_t bits) {
    for (unsigned shift = 0; shift < 64; shift += 8) hash_.add(static_cast<unsigned char>(bits >> shift));
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(float number) { add(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(number))); }
  void add(const std::string& text) {
    add(std::uint64_t{text.size()});
    for (const char letter : text) add(static_cast<std::uint64_t>(static_cast<unsigned char>(letter)));
  }
  void add(const std::optional<std::uint32_t>& index) { add(index ? std::uint64_t{*index} : ~std::uint64_t{0}); }
  void add(const glm::vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const glm::vec4& v) {
    for (int i = 0; i < 4; ++i) add(v[i]);
  }
  void add(const glm::vec2& v) {
    for (int i = 0; i < 2; ++i) add(v[i]);
  }
  void add(bool flag) { add(std::uint64_t{flag}); }
  void add(const std::optional<float>& number) { add(number.value_or(-1.0F)); }
  void add(const std::array<TextureUse, kTextureSlots>& textures) {
    for (const TextureUse& use : textures) {
      add(use.texture);
      add(std::uint64_t{use.coordinates});
      add(use.offset);
      add(use.scale);
      add(use.rotation_rad);
    }
  }
  void add(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) add(matrix[column][row]);
    }
  }

 private:
  core::Fnv1a hash_;
};

void add_node(Digest& digest, const Node& node) {
  digest.add(node.name);
  digest.add(node.parent);
  digest.add(node.mesh);
  digest.add(node.parent_from_node);
  digest.add(std::uint64_t{node.most_copies} << 1U | (node.reshaped ? 1U : 0U));
}

void add_primitive(Digest& digest, const Primitive& primitive) {
  digest.add(std::uint64_t{primitive.material});
  digest.add(static_cast<std::uint64_t>(primitive.topology) | static_cast<std::uint64_t>(primitive.normals) << 2U);
  digest.add(std::uint64_t{primitive.vertices.size()});
  for (const Vertex& vertex : primitive.vertices) {
    digest.add(vertex.position);
    digest.add(vertex.normal);
    digest.add(vertex.color);
  }
  digest.add(std::uint64_t{primitive.indices.size()});
  for (const std::uint32_t index : primitive.indices) digest.add(std::uint64_t{index});
  digest.add(std::uint64_t{primitive.texture_coordinates.size()});
  for (const TextureCoordinates& place : primitive.texture_coordinates) {
    digest.add(place.set_0);
    digest.add(place.set_1);
  }
  for (const glm::vec4& tangent : primitive.tangents) digest.add(tangent);
}

void add_image(Digest& digest, const Image& image) {
  digest.add(std::uint64_t{image.width} << 32U | image.height);

  // rows are whole words of four bytes
  for (std::size_t i = 0; i + 4 <= image.rgba.size(); i += 4) {
    std::uint32_t pixel = 0;
    std::memcpy(&pixel, &image.rgba[i], sizeof pixel);
    digest.add(std::uint64_t{pixel});
  }
}

}  // namespace

std::uint64_t digest(const Scene& scene) {
  Digest digest;
  digest.add(std::uint64_t{scene.nodes.size()});
  for (const Node& node : scene.nodes) add_node(digest, node);
  digest.add(std::uint64_t{scene.meshes.size()});
  for (const Mesh& mesh : scene.meshes) {
    digest.add(mesh.name);
    digest.add(std::uint64_t{mesh.primitives.size()});
    for (const Primitive& primitive : mesh.primitives) add_primitive(digest, primitive);
  }
  digest.add(std::uint64_t{scene.materials.size()});
  for (const PbrMaterial& material : scene.materials) {
    for_each_pbr_field([&](const auto& field) { digest.add(material.*field.member); });
  }
  for (const Texture& texture : scene.textures) {
    digest.add(std::uint64_t{texture.image} << 32U | static_cast<std::uint64_t>(texture.magnified) |
               static_cast<std::uint64_t>(texture.minified) << 2U |
               static_cast<std::uint64_t>(texture.between_mips ? 1U + static_cast<unsigned>(*texture.between_mips) : 0U)
                   << 4U |
               static_cast<std::uint64_t>(texture.wrap_u) << 6U | static_cast<std::uint64_t>(texture.wrap_v) << 8U);
  }
  for (const Image& image : scene.images) add_image(digest, image);
  return digest.value();
}

}  // namespace afm::scene
