// SPDX-License-Identifier: Apache-2.0
#include "scene/graph/scene.h"

#include <algorithm>

#include "core/check.h"

namespace afm::scene {
namespace {

// Offsets of the part's lists within the whole.
struct Offsets {
  std::uint32_t node, mesh, material, texture, image, skin, camera, light, variant;
};

void shift(std::optional<std::uint32_t>& index, std::uint32_t offset) {
  if (index) *index += offset;
}

void append_nodes(Scene& scene, const Scene& part, std::string_view name, NodeIndex root, const Offsets& at) {
  for (const Node& source : part.nodes) {
    Node& node = scene.nodes.emplace_back(source);
    node.name = std::string(name) + "/" + source.name;
    node.parent = source.parent ? *source.parent + at.node : root;
    shift(node.mesh, at.mesh);
    shift(node.skin, at.skin);
    shift(node.camera, at.camera);
    shift(node.light, at.light);
  }
  for (Skin skin : part.skins) {
    for (NodeIndex& joint : skin.joints) joint += at.node;
    scene.skins.push_back(std::move(skin));
  }
  for (Animation animation : part.animations) {
    for (AnimatedNode& animated : animation.nodes) animated.node += at.node;
    scene.animations.push_back(std::move(animation));
  }
  scene.cameras.insert(scene.cameras.end(), part.cameras.begin(), part.cameras.end());
  scene.lights.insert(scene.lights.end(), part.lights.begin(), part.lights.end());
}

void append_looks(Scene& scene, const Scene& part, const Offsets& at) {
  for (PbrMaterial material : part.materials) {
    for (TextureUse& use : material.textures) shift(use.texture, at.texture);
    scene.materials.push_back(std::move(material));
  }
  for (Texture texture : part.textures) {
    texture.image += at.image;
    scene.textures.push_back(texture);
  }
  scene.images.insert(scene.images.end(), part.images.begin(), part.images.end());
  scene.variants.insert(scene.variants.end(), part.variants.begin(), part.variants.end());
}

void append_meshes(Scene& scene, const Scene& part, const Offsets& at) {
  for (const Mesh& source : part.meshes) {
    Mesh& mesh = scene.meshes.emplace_back(source);
    for (Primitive& primitive : mesh.primitives) {
      primitive.material += at.material;
      for (VariantMaterial& mapping : primitive.variants) {
        mapping.variant += at.variant;
        mapping.material += at.material;
      }
    }
  }
}

template <class T>
std::uint32_t count(const std::vector<T>& list) {
  return static_cast<std::uint32_t>(list.size());
}

}  // namespace

std::optional<NodeIndex> Scene::find_node(std::string_view name) const {
  const auto found = std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) { return node.name == name; });
  if (found == nodes.end()) return std::nullopt;
  return static_cast<NodeIndex>(found - nodes.begin());
}

NodeIndex append(Scene& scene, const Scene& part, std::string_view name, std::optional<NodeIndex> parent,
                 const glm::dmat4& parent_from_name) {
  AFM_CHECK(!parent || *parent < scene.nodes.size());
  const NodeIndex root = count(scene.nodes);
  const Offsets at{
      root + 1,           count(scene.meshes),  count(scene.materials), count(scene.textures), count(scene.images),
      count(scene.skins), count(scene.cameras), count(scene.lights),    count(scene.variants)};
  scene.nodes.push_back(Node{std::string(name), parent, std::nullopt, parent_from_name});
  append_nodes(scene, part, name, root, at);
  append_looks(scene, part, at);
  append_meshes(scene, part, at);
  return root;
}

}  // namespace afm::scene
