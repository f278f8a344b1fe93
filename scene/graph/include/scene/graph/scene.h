// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/graph/animation.h"
#include "scene/graph/pbr_material.h"

namespace afm::scene {

// Linear RGB; positions and normals in the frame of the node that shows the mesh, in glTF's metres.
struct Vertex {
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F, 0.0F, 1.0F};
  glm::vec4 color{1.0F};
};

// Strips, fans and loops become these when they are loaded.
enum class Topology { Triangles, Lines, Points };

// Source of a primitive's normals: the file, its triangles, or none: such lines and points are not lit.
enum class Normals { Given, Flat, None };

struct TextureCoordinates {
  glm::vec2 set_0{0.0F};
  glm::vec2 set_1{0.0F};
};

// Joints of the node's skin that move a vertex, with their weights.
struct Influence {
  std::array<std::uint32_t, 4> joints{};
  glm::vec4 weights{0.0F};
};

// Displacements that a morph target adds to the vertices; missing streams are empty.
struct MorphTarget {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec3> tangents;
};

// Material of a primitive in a variant of the scene (KHR_materials_variants).
struct VariantMaterial {
  std::uint32_t variant = 0;
  std::uint32_t material = 0;
};

// A list of triangles, lines or points; indices into its own vertices, all of them valid. Rare attributes are separate
// streams: each is empty or has one entry per vertex.
struct Primitive {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::uint32_t material = 0;
  Topology topology = Topology::Triangles;
  Normals normals = Normals::Given;
  std::vector<TextureCoordinates> texture_coordinates{};
  std::vector<glm::vec4> tangents{};  // xyz: unit vector; w: sign of the bitangent
  std::vector<Influence> influences{};
  std::vector<Influence> more_influences{};  // influences of joints 4 to 7
  std::vector<MorphTarget> targets{};
  std::vector<VariantMaterial> variants{};
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
  std::vector<float> weights{};  // one weight per morph target of each primitive
};

// glTF 2.0 cameras look along their node's -z with +y up.
struct Camera {
  std::string name;
  bool perspective = true;
  float yfov_rad = 0.0F;                // vertical field of view; perspective only
  std::optional<float> aspect_ratio{};  // width to height; none: that of the picture
  glm::vec2 half_size_m{0.0F};          // half width and height of the view; orthographic only
  float near_m = 0.0F;
  std::optional<float> far_m{};  // far plane; none: infinite
};

// KHR_lights_punctual: shines along its node's -z, or all around.
struct PunctualLight {
  enum class Kind { Directional, Point, Spot };
  std::string name;
  Kind kind = Kind::Point;
  glm::vec3 intensity{1.0F};       // colour times lux (directional) or candela (others)
  std::optional<float> range_m{};  // distance beyond which there is no light; none: unlimited
  float inner_cone_rad = 0.0F;
  float outer_cone_rad = 0.0F;
};

// Parents come before their children, so that one pass in order composes all transforms.
struct Node {
  std::string name;
  std::optional<NodeIndex> parent;
  std::optional<std::uint32_t> mesh;
  glm::dmat4 parent_from_node{1.0};
  std::optional<std::uint32_t> skin{};
  std::optional<std::uint32_t> camera{};
  std::optional<std::uint32_t> light{};
  std::vector<float> weights{};   // morph target weights that replace the mesh's own
  std::uint32_t most_copies = 0;  // largest number of copies of the mesh that a frame shows in its place; 0: none
  bool reshaped = false;          // true: a frame gives the vertices of its mesh, one primitive, within the mesh's box
  std::string role{};             // role in TouchAFM (docs/gltf.md): "tip", "base", "surface" or "mark"
};

// The scene graph: filled by the loader, constant from then on, and shared by all code that draws or feels. Moving
// state is kept outside, in a SceneTransforms block (scene/shared_blocks.h) indexed like `nodes`.
struct Scene {
  std::vector<Node> nodes;
  std::vector<Mesh> meshes;
  std::vector<PbrMaterial> materials;
  std::vector<Texture> textures{};
  std::vector<Image> images{};
  std::vector<Skin> skins{};
  std::vector<Camera> cameras{};
  std::vector<PunctualLight> lights{};
  std::vector<Animation> animations{};
  std::vector<std::string> variants{};

  // First node of that name, if there is one.
  std::optional<NodeIndex> find_node(std::string_view name) const;
};

// Copies `part` below a new node `name` (child of `parent`, or a root) whose transform is `parent_from_name`; names
// inside the part become "name/inner". Returns the new node.
NodeIndex append(Scene& scene, const Scene& part, std::string_view name, std::optional<NodeIndex> parent,
                 const glm::dmat4& parent_from_name);

// Digest of nodes, meshes, materials, textures and images (64-bit FNV-1a). Within one run, a renderer uses it to
// recognise the servo of its scene. Excludes lights, cameras, skins, morph targets, animations and variants.
std::uint64_t digest(const Scene& scene);

}  // namespace afm::scene
