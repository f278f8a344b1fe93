// SPDX-License-Identifier: Apache-2.0
#include "drawing/scene_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <set>
#include <span>

#include "core/check.h"
#include "drawing/mesh_order.h"
#include "render/frame.h"

namespace afm::render {
namespace {

// glTF: alpha, including that of vertices, is ignored unless the material blends or is a mask.
bool ignores_alpha(const scene::PbrMaterial& material) { return !material.blended && !material.alpha_cutoff; }

DrawBlock material_block(const scene::PbrMaterial& material) {
  DrawBlock block{};
  block.base_color = material.base_color;
  if (ignores_alpha(material)) {
    block.base_color.a = 1.0F;
  }
  block.emissive = glm::vec4(material.emissive, 0.0F);
  block.surface = glm::vec4(material.metallic, material.roughness, material.unlit ? 1.0F : 0.0F, 0.0F);
  return block;
}

void measure_box(const scene::Primitive& primitive, Draw& draw) {
  if (primitive.vertices.empty()) {
    return;
  }
  glm::vec3 low = primitive.vertices.front().position;
  glm::vec3 high = low;
  for (const auto& vertex : primitive.vertices) {
    low = glm::min(low, vertex.position);
    high = glm::max(high, vertex.position);
    draw.reach = std::max(draw.reach, glm::length(vertex.position));
  }
  draw.center = 0.5F * (low + high);
  draw.half_size = 0.5F * (high - low);
}

void measure_edges(const scene::Primitive& primitive, Draw& draw) {
  if (primitive.topology != scene::Topology::Triangles || primitive.indices.size() < 3) {
    return;
  }
  std::vector<float> longest;
  float least_cosine = 1.0F;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    float edge = 0.0F;
    for (std::size_t k = 0; k < 3; ++k) {
      const scene::Vertex &from = primitive.vertices[primitive.indices[i + k]],
                          &to = primitive.vertices[primitive.indices[i + (k + 1) % 3]];
      edge = std::max(edge, glm::distance(from.position, to.position));
      least_cosine = std::min(least_cosine, glm::dot(from.normal, to.normal));
    }
    longest.push_back(edge);
  }
  draw.largest_turn = std::acos(std::clamp(least_cosine, -1.0F, 1.0F));
  const auto usual = longest.begin() + static_cast<std::ptrdiff_t>(longest.size() * 9 / 10);
  std::nth_element(longest.begin(), usual, longest.end());
  draw.usual_edge = *usual;
  draw.longest_edge = *std::max_element(usual, longest.end());
}

// Vertices and indices of all meshes end to end, those with a look first, and the position of each primitive.
struct Packed {
  std::vector<scene::Vertex> vertices;
  std::vector<LookVertex> variant_vertices;
  std::vector<std::uint32_t> indices;
  std::vector<ShaderVariant> variants;
  std::vector<std::vector<Draw>> draws_of_mesh;
};

std::uint32_t place_of(const ShaderVariant& variant, std::vector<ShaderVariant>& variants) {
  const auto found = std::find(variants.begin(), variants.end(), variant);
  const auto place = static_cast<std::uint32_t>(found - variants.begin());
  if (found == variants.end()) {
    variants.push_back(variant);
  }
  return place;
}

void pack_variant(const scene::Primitive& primitive, const MeshOrder& order, std::vector<LookVertex>& vertices) {
  for (const std::uint32_t i : order.vertices) {
    LookVertex& vertex = vertices.emplace_back();
    if (!primitive.tangents.empty()) {
      vertex.tangent = primitive.tangents[i];
    }
    if (!primitive.texture_coordinates.empty()) {
      vertex.coordinates = glm::vec4(primitive.texture_coordinates[i].set_0, primitive.texture_coordinates[i].set_1);
    }
  }
}

void pack_primitive(const scene::Scene& scene, const scene::Primitive& primitive,
                    const std::optional<ShaderVariant>& variant, bool reshaped, Packed& packed,
                    std::vector<Draw>& draws) {
  const auto& material = scene.materials.at(primitive.material);
  const MeshOrder order = drawing_order(primitive, material.blended || reshaped);
  draws.push_back({.node = 0,
                   .first_index = static_cast<std::uint32_t>(packed.indices.size()),
                   .index_count = static_cast<std::uint32_t>(order.indices.size()),
                   .first_vertex = static_cast<std::int32_t>(packed.vertices.size()),
                   .double_sided = material.double_sided,
                   .unlit = material.unlit,
                   .blended = material.blended,
                   .casts_shadow = !material.blended && primitive.topology == scene::Topology::Triangles,
                   .material = primitive.material,
                   .block = material_block(material)});
  if (variant) {
    draws.back().variant = place_of(*variant, packed.variants);
    pack_variant(primitive, order, packed.variant_vertices);
  }
  measure_box(primitive, draws.back());
  measure_edges(primitive, draws.back());
  for (const std::uint32_t i : order.vertices) {
    packed.vertices.push_back(primitive.vertices[i]);
    if (ignores_alpha(material)) {
      packed.vertices.back().color.a = 1.0F;
    }
  }
  packed.indices.insert(packed.indices.end(), order.indices.begin(), order.indices.end());
}

Packed pack(const scene::Scene& scene) {
  Packed packed;
  packed.draws_of_mesh.resize(scene.meshes.size());
  std::set<std::size_t> reshaped;  // indices of meshes
  for (const scene::Node& node : scene.nodes) {
    if (node.reshaped && node.mesh) reshaped.insert(*node.mesh);
  }
  for (const bool with_variant : {true, false}) {
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
      for (const auto& primitive : scene.meshes[i].primitives) {
        const auto variant = variant_of(scene, primitive);
        if (variant.has_value() == with_variant) {
          pack_primitive(scene, primitive, variant, reshaped.contains(i), packed, packed.draws_of_mesh[i]);
        }
      }
    }
  }

  // a scene without a mesh still needs buffers to bind
  if (packed.indices.empty()) {
    packed.vertices.emplace_back();
    packed.indices.push_back(0);
  }
  return packed;
}

std::uint32_t vertex_count_of(const scene::Scene& scene, const scene::Node& node) {
  const auto& primitives = scene.meshes.at(node.mesh.value()).primitives;
  AFM_CHECK(primitives.size() == 1 && node.most_copies == 0);
  return static_cast<std::uint32_t>(primitives.front().vertices.size());
}

void reshape(Draw& draw, std::uint32_t first_vertex) {
  AFM_CHECK(!draw.variant);  // shape drawn by the plain pipelines
  draw.reshaped = true;
  draw.casts_shadow = false;
  draw.longest_edge = 2.0F * glm::length(draw.half_size);
  draw.first_vertex = static_cast<std::int32_t>(first_vertex);
}

}  // namespace

SceneGeometry::SceneGeometry(const Device& device, const scene::Scene& scene) {
  const Packed packed = pack(scene);
  variants_ = packed.variants;
  for (scene::NodeIndex index = 0; index < scene.nodes.size(); ++index) {
    const auto& node = scene.nodes[index];
    parents_.push_back(node.parent);
    most_copies_.push_back(node.most_copies);
    shape_sizes_.push_back(node.reshaped ? vertex_count_of(scene, node) : 0);
    if (node.mesh) {
      for (Draw draw : packed.draws_of_mesh.at(*node.mesh)) {
        draw.node = index;
        draw.most_copies = node.most_copies;
        draw.first_copy = copy_count_;
        // copies are drawn by a pipeline for plain, opaque materials
        AFM_CHECK(draw.most_copies == 0 || (!draw.variant && !draw.blended && !draw.unlit));
        if (node.reshaped) reshape(draw, shape_count_);
        draws_.push_back(draw);
      }
    }
    copy_count_ += node.most_copies;
    shape_count_ += shape_sizes_.back();
  }
  std::stable_sort(draws_.begin(), draws_.end(), [](const Draw& a, const Draw& b) { return a.blended < b.blended; });
  vertices_ = upload_buffer(device, "scene vertices", std::as_bytes(std::span(packed.vertices)),
                            vk::BufferUsageFlagBits::eVertexBuffer);
  if (!variants_.empty()) {
    variant_vertices_ = upload_buffer(device, "scene look vertices", std::as_bytes(std::span(packed.variant_vertices)),
                                      vk::BufferUsageFlagBits::eVertexBuffer);
  }
  indices_ = upload_buffer(device, "scene indices", std::as_bytes(std::span(packed.indices)),
                           vk::BufferUsageFlagBits::eIndexBuffer);
}

void SceneGeometry::bind(const vk::raii::CommandBuffer& command) const {
  command.bindVertexBuffers(0, *vertices_.buffer, vk::DeviceSize{0});
  if (!variants_.empty()) {
    command.bindVertexBuffers(1, *variant_vertices_.buffer, vk::DeviceSize{0});
  }
  command.bindIndexBuffer(*indices_.buffer, 0, vk::IndexType::eUint32);
}

const std::array<vk::VertexInputBindingDescription, 1>& SceneGeometry::bindings() {
  static constexpr std::array<vk::VertexInputBindingDescription, 1> kBindings{
      {{.binding = 0, .stride = sizeof(scene::Vertex), .inputRate = vk::VertexInputRate::eVertex}}};
  return kBindings;
}

const std::array<vk::VertexInputAttributeDescription, 3>& SceneGeometry::attributes() {
  static constexpr std::array<vk::VertexInputAttributeDescription, 3> kAttributes{
      {{.location = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(scene::Vertex, position)},
       {.location = 1, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(scene::Vertex, normal)},
       {.location = 2, .format = vk::Format::eR32G32B32A32Sfloat, .offset = offsetof(scene::Vertex, color)}}};
  return kAttributes;
}

const std::array<vk::VertexInputBindingDescription, 2>& SceneGeometry::copy_bindings() {
  static const std::array<vk::VertexInputBindingDescription, 2> kBindings{
      {bindings()[0],
       {.binding = kCopyBinding, .stride = sizeof(MeshCopy), .inputRate = vk::VertexInputRate::eInstance}}};
  return kBindings;
}

const std::array<vk::VertexInputAttributeDescription, 6>& SceneGeometry::copy_attributes() {
  static_assert(offsetof(MeshCopy, scale) == 12 && sizeof(MeshCopy) == 48);  // place and scale form one vector
  const auto of_copy = [](std::uint32_t location, std::uint32_t offset) {
    return vk::VertexInputAttributeDescription{
        .location = location, .binding = kCopyBinding, .format = vk::Format::eR32G32B32A32Sfloat, .offset = offset};
  };
  static const std::array<vk::VertexInputAttributeDescription, 6> kAttributes{
      {attributes()[0], attributes()[1], attributes()[2], of_copy(3, offsetof(MeshCopy, place)),
       of_copy(4, offsetof(MeshCopy, turn)), of_copy(5, offsetof(MeshCopy, tint))}};
  return kAttributes;
}

const std::array<vk::VertexInputBindingDescription, 2>& SceneGeometry::variant_bindings() {
  static const std::array<vk::VertexInputBindingDescription, 2> kBindings{
      {bindings()[0], {.binding = 1, .stride = sizeof(LookVertex), .inputRate = vk::VertexInputRate::eVertex}}};
  return kBindings;
}

const std::array<vk::VertexInputAttributeDescription, 5>& SceneGeometry::variant_attributes() {
  static const std::array<vk::VertexInputAttributeDescription, 5> kAttributes{
      {attributes()[0],
       attributes()[1],
       attributes()[2],
       {.location = 3,
        .binding = 1,
        .format = vk::Format::eR32G32B32A32Sfloat,
        .offset = offsetof(LookVertex, tangent)},
       {.location = 4,
        .binding = 1,
        .format = vk::Format::eR32G32B32A32Sfloat,
        .offset = offsetof(LookVertex, coordinates)}}};
  return kAttributes;
}

}  // namespace afm::render
