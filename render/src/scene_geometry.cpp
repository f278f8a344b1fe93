// SPDX-License-Identifier: Apache-2.0
#include "scene_geometry.h"

#include <algorithm>
#include <cstddef>
#include <glm/common.hpp>
#include <span>

namespace afm::render {
namespace {

DrawBlock material_block(const scene::Material& material) {
  DrawBlock block{};
  block.base_color = material.base_color;
  if (!material.blended) {
    block.base_color.a = 1.0F;  // glTF: alpha is ignored unless the material blends
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
  }
  draw.center = 0.5F * (low + high);
  draw.half_size = 0.5F * (high - low);
}

// Vertices and indices of all meshes end to end, and where each primitive lies.
struct Packed {
  std::vector<scene::Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<std::vector<Draw>> draws_of_mesh;
};

Packed pack(const scene::Scene& scene) {
  Packed packed;
  for (const auto& mesh : scene.meshes) {
    auto& draws = packed.draws_of_mesh.emplace_back();
    for (const auto& primitive : mesh.primitives) {
      const auto& material = scene.materials.at(primitive.material);
      draws.push_back({.node = 0,
                       .first_index = static_cast<std::uint32_t>(packed.indices.size()),
                       .index_count = static_cast<std::uint32_t>(primitive.indices.size()),
                       .first_vertex = static_cast<std::int32_t>(packed.vertices.size()),
                       .double_sided = material.double_sided,
                       .blended = material.blended,
                       .block = material_block(material)});
      measure_box(primitive, draws.back());
      packed.vertices.insert(packed.vertices.end(), primitive.vertices.begin(), primitive.vertices.end());
      packed.indices.insert(packed.indices.end(), primitive.indices.begin(), primitive.indices.end());
    }
  }

  // a scene without a mesh still gets buffers that can be bound
  if (packed.indices.empty()) {
    packed.vertices.emplace_back();
    packed.indices.push_back(0);
  }
  return packed;
}

}  // namespace

SceneGeometry::SceneGeometry(const Device& device, const scene::Scene& scene) {
  const Packed packed = pack(scene);
  for (scene::NodeIndex index = 0; index < scene.nodes.size(); ++index) {
    const auto& node = scene.nodes[index];
    parents_.push_back(node.parent);
    if (node.mesh) {
      for (Draw draw : packed.draws_of_mesh.at(*node.mesh)) {
        draw.node = index;
        draws_.push_back(draw);
      }
    }
  }
  std::stable_sort(draws_.begin(), draws_.end(), [](const Draw& a, const Draw& b) { return a.blended < b.blended; });
  opaque_count_ = static_cast<std::size_t>(
      std::count_if(draws_.begin(), draws_.end(), [](const Draw& draw) { return !draw.blended; }));
  vertices_ = upload_buffer(device, "scene vertices", std::as_bytes(std::span(packed.vertices)),
                            vk::BufferUsageFlagBits::eVertexBuffer);
  indices_ = upload_buffer(device, "scene indices", std::as_bytes(std::span(packed.indices)),
                           vk::BufferUsageFlagBits::eIndexBuffer);
}

void SceneGeometry::bind(const vk::raii::CommandBuffer& command) const {
  command.bindVertexBuffers(0, *vertices_.buffer, vk::DeviceSize{0});
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

}  // namespace afm::render
