// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "device/memory.h"
#include "device/shader_interface.h"
#include "drawing/shader_variant.h"
#include "scene/graph/scene.h"

namespace afm::render {

// One primitive shown by one node: an indexed draw. Its index in SceneGeometry::draws() is also that of its DrawBlock.
struct Draw {
  scene::NodeIndex node = 0;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::int32_t first_vertex = 0;
  bool double_sided = false;
  bool unlit = false;
  bool blended = false;
  bool casts_shadow = true;
  std::optional<std::uint32_t> variant{};  // index into SceneGeometry::variants(); none: drawn by the plain pipelines
  std::uint32_t material = 0;
  glm::vec3 center{0.0F};  // centre of the primitive's box, in the node's frame
  glm::vec3 half_size{0.0F};
  float reach = 0.0F;             // largest distance of a vertex from the mesh's origin
  std::uint32_t most_copies = 0;  // 0: no copies, so the mesh itself is drawn
  std::uint32_t first_copy = 0;   // index in the buffer of all copies
  bool reshaped = false;      // true: vertices from the frame; first_vertex is their index in the buffer of all shapes
  float usual_edge = 0.0F;    // upper bound for the longest edges of nine triangles in ten, in the node's frame
  float longest_edge = 0.0F;  // longest edge of all triangles; 0: no triangles
  float largest_turn = 0.0F;  // largest angle between the normals at two corners of a triangle, in radians
  DrawBlock block{};          // constants, including those of the material
};

// Vertex data read only by a ShaderVariant.
struct LookVertex {
  glm::vec4 tangent{0.0F};
  glm::vec4 coordinates{0.0F};
};

// Vertex buffer of the copies: render::MeshCopy, one per instance.
inline constexpr std::uint32_t kCopyBinding = 2;

// All meshes of a scene in one vertex and one index buffer, and its draws: opaque ones first, then blended ones.
class SceneGeometry {
 public:
  SceneGeometry(const Device& device, const scene::Scene& scene);

  const std::vector<Draw>& draws() const { return draws_; }
  const std::vector<std::optional<scene::NodeIndex>>& parents() const { return parents_; }

  const std::vector<ShaderVariant>& variants() const { return variants_; }

  // Largest number of copies of a node's mesh, and of all nodes together.
  std::uint32_t most_copies(scene::NodeIndex node) const { return most_copies_[node]; }
  std::uint32_t copy_count() const { return copy_count_; }

  // Number of vertices of a node's mesh that a frame gives, 0 if it gives none, and of all nodes together.
  std::uint32_t shape_size(scene::NodeIndex node) const { return shape_sizes_[node]; }
  std::uint32_t shape_count() const { return shape_count_; }

  void bind(const vk::raii::CommandBuffer& command) const;

  static const std::array<vk::VertexInputBindingDescription, 1>& bindings();
  static const std::array<vk::VertexInputAttributeDescription, 3>& attributes();
  static const std::array<vk::VertexInputBindingDescription, 2>& copy_bindings();  // second binding: kCopyBinding
  static const std::array<vk::VertexInputAttributeDescription, 6>& copy_attributes();
  static const std::array<vk::VertexInputBindingDescription, 2>& variant_bindings();
  static const std::array<vk::VertexInputAttributeDescription, 5>& variant_attributes();

 private:
  std::vector<Draw> draws_;
  std::vector<std::optional<scene::NodeIndex>> parents_;
  std::vector<ShaderVariant> variants_;
  std::vector<std::uint32_t> most_copies_;  // indexed by node
  std::uint32_t copy_count_ = 0;
  std::vector<std::uint32_t> shape_sizes_;  // indexed by node
  std::uint32_t shape_count_ = 0;
  Buffer vertices_;
  Buffer variant_vertices_;  // LookVertex data, from the first vertex with a look on
  Buffer indices_;
};

}  // namespace afm::render
