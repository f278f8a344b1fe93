// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.h"

#include <algorithm>
#include <bit>

#include "core/check.h"

namespace afm::scene {
namespace {

// 64-bit FNV-1a (Fowler, Noll, Vo; draft-eastlake-fnv, section 5) over values in a fixed order and byte order.
class Digest {
 public:
  std::uint64_t value() const { return value_; }

  void add(std::uint64_t bits) {
    for (unsigned shift = 0; shift < 64; shift += 8) {
      value_ = (value_ ^ ((bits >> shift) & 0xFFU)) * 0x100000001B3ULL;
    }
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
  void add(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) add(matrix[column][row]);
    }
  }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325ULL;
};

}  // namespace

std::optional<NodeIndex> Scene::find_node(std::string_view name) const {
  const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) { return node.name == name; });
  if (found == nodes.end()) return std::nullopt;
  return static_cast<NodeIndex>(found - nodes.begin());
}

NodeIndex append(Scene& scene, const Scene& part, std::string_view name, std::optional<NodeIndex> parent,
                 const glm::dmat4& parent_from_name) {
  AFM_CHECK(!parent || *parent < scene.nodes.size());
  const auto first_mesh = static_cast<std::uint32_t>(scene.meshes.size());
  const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
  const auto root = static_cast<NodeIndex>(scene.nodes.size());

  scene.nodes.push_back(Node{std::string(name), parent, std::nullopt, parent_from_name});
  for (const Node& source : part.nodes) {
    Node node = source;
    node.name = std::string(name) + "/" + source.name;
    node.parent = source.parent ? *source.parent + root + 1 : root;
    if (source.mesh) node.mesh = *source.mesh + first_mesh;
    scene.nodes.push_back(std::move(node));
  }
  scene.materials.insert(scene.materials.end(), part.materials.begin(), part.materials.end());
  for (const Mesh& source : part.meshes) {
    Mesh mesh = source;
    for (Primitive& primitive : mesh.primitives) primitive.material += first_material;
    scene.meshes.push_back(std::move(mesh));
  }
  return root;
}

std::uint64_t digest(const Scene& scene) {
  Digest digest;
  digest.add(std::uint64_t{scene.nodes.size()});
  for (const Node& node : scene.nodes) {
    digest.add(node.name);
    digest.add(node.parent);
    digest.add(node.mesh);
    digest.add(node.parent_from_node);
  }
  digest.add(std::uint64_t{scene.meshes.size()});
  for (const Mesh& mesh : scene.meshes) {
    digest.add(mesh.name);
    digest.add(std::uint64_t{mesh.primitives.size()});
    for (const Primitive& primitive : mesh.primitives) {
      digest.add(std::uint64_t{primitive.material});
      digest.add(std::uint64_t{primitive.vertices.size()});
      for (const Vertex& vertex : primitive.vertices) {
        digest.add(vertex.position);
        digest.add(vertex.normal);
        digest.add(vertex.color);
      }
      digest.add(std::uint64_t{primitive.indices.size()});
      for (const std::uint32_t index : primitive.indices) digest.add(std::uint64_t{index});
    }
  }
  digest.add(std::uint64_t{scene.materials.size()});
  for (const Material& material : scene.materials) {
    digest.add(material.name);
    digest.add(material.base_color);
    digest.add(material.emissive);
    digest.add(material.metallic);
    digest.add(material.roughness);
    digest.add(std::uint64_t{material.double_sided} | std::uint64_t{material.blended} << 1U |
               std::uint64_t{material.unlit} << 2U);
  }
  return digest.value();
}

}  // namespace afm::scene
