// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace afm::scene {

// Linear RGB; positions and normals in the frame of the node that shows the mesh, in glTF's metres.
struct Vertex {
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F, 0.0F, 1.0F};
  glm::vec4 color{1.0F};
};

// glTF 2.0 metallic-roughness factors, linear.
struct Material {
  std::string name;
  glm::vec4 base_color{1.0F};
  glm::vec3 emissive{0.0F};
  float metallic = 1.0F;
  float roughness = 1.0F;
  bool double_sided = false;
  bool blended = false;  // alphaMode BLEND: drawn after the opaque primitives, writes no depth, casts no shadow
  bool unlit = false;    // KHR_materials_unlit
};

// A triangle list; indices into its own vertices, all of them valid.
struct Primitive {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::uint32_t material = 0;
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

using NodeIndex = std::uint32_t;

// Parents stand before their children, so that one pass in order composes all transforms.
struct Node {
  std::string name;
  std::optional<NodeIndex> parent;
  std::optional<std::uint32_t> mesh;
  glm::dmat4 parent_from_node{1.0};
};

// The scene graph: filled by the loader, constant from then on, and shared by everything that draws or feels. What moves
// lives outside it, in a SceneTransforms block (scene/shared_blocks.h) indexed like `nodes`.
struct Scene {
  std::vector<Node> nodes;
  std::vector<Mesh> meshes;
  std::vector<Material> materials;

  // The first node of that name, if there is one.
  std::optional<NodeIndex> find_node(std::string_view name) const;
};

// Copies `part` below a new node `name` (child of `parent`, or a root) whose transform is `parent_from_name`; names inside
// the part become "name/inner". Returns the new node.
NodeIndex append(Scene& scene, const Scene& part, std::string_view name, std::optional<NodeIndex> parent,
                 const glm::dmat4& parent_from_name);

// A digest of the nodes' names, parents and rest transforms, of the meshes and of the materials (64-bit FNV-1a): two
// programs that agree on it share the same scene.
std::uint64_t digest(const Scene& scene);

}  // namespace afm::scene
