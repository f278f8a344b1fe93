// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "memory.h"
#include "scene/scene.h"
#include "shader_interface.h"

namespace afm::render {

// One primitive shown by one node: an indexed draw. Its place in SceneGeometry::draws() is its place among the
// DrawBlocks.
struct Draw {
  scene::NodeIndex node = 0;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::int32_t first_vertex = 0;
  bool double_sided = false;
  bool blended = false;
  glm::vec3 center{0.0F};  // of the primitive's box, in the node's frame
  glm::vec3 half_size{0.0F};
  DrawBlock block{};  // with the material's constants filled in
};

// All meshes of a scene in one vertex and one index buffer, and its draws: opaque ones first, then blended ones.
class SceneGeometry {
 public:
  SceneGeometry(const Device& device, const scene::Scene& scene);

  const std::vector<Draw>& draws() const { return draws_; }
  std::size_t opaque_count() const { return opaque_count_; }
  const std::vector<std::optional<scene::NodeIndex>>& parents() const { return parents_; }

  void bind(const vk::raii::CommandBuffer& command) const;

  static const std::array<vk::VertexInputBindingDescription, 1>& bindings();
  static const std::array<vk::VertexInputAttributeDescription, 3>& attributes();

 private:
  std::vector<Draw> draws_;
  std::size_t opaque_count_ = 0;
  std::vector<std::optional<scene::NodeIndex>> parents_;
  Buffer vertices_;
  Buffer indices_;
};

}  // namespace afm::render
