// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include "fuzz/accepted.h"
#include "fuzz/memory_file.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/graph/pose.h"

namespace afm {
namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

template <class T>
bool fits(const std::vector<T>& stream, const scene::Primitive& primitive) {
  return stream.empty() || stream.size() == primitive.vertices.size();
}

void check(const scene::Primitive& primitive, const scene::Scene& scene) {
  require(primitive.material < scene.materials.size());
  for (const std::uint32_t index : primitive.indices) require(index < primitive.vertices.size());
  require(fits(primitive.texture_coordinates, primitive) && fits(primitive.tangents, primitive));
  require(fits(primitive.influences, primitive) && fits(primitive.more_influences, primitive));
  for (const scene::MorphTarget& target : primitive.targets) {
    require(fits(target.positions, primitive) && fits(target.normals, primitive) && fits(target.tangents, primitive));
  }
  for (const scene::VariantMaterial& mapping : primitive.variants) {
    require(mapping.variant < scene.variants.size() && mapping.material < scene.materials.size());
  }
}

void check(const scene::Scene& scene) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const scene::Node& node = scene.nodes[i];
    require(!node.parent || *node.parent < i);
    require(!node.mesh || *node.mesh < scene.meshes.size());
    require(!node.skin || *node.skin < scene.skins.size());
    require(!node.camera || *node.camera < scene.cameras.size());
    require(!node.light || *node.light < scene.lights.size());
  }
  for (const scene::Mesh& mesh : scene.meshes) {
    for (const scene::Primitive& primitive : mesh.primitives) check(primitive, scene);
  }
  for (const scene::PbrMaterial& material : scene.materials) {
    for (const scene::TextureUse& use : material.textures)
      require(!use.texture || *use.texture < scene.textures.size());
  }
  for (const scene::Texture& texture : scene.textures) require(texture.image < scene.images.size());
  for (const scene::Image& image : scene.images) {
    require(image.rgba.size() == std::size_t{4} * image.width * image.height && !image.rgba.empty());
  }
}

}  // namespace
}  // namespace afm

// Whatever the bytes: a scene whose every index is within bounds, also where its animations put it, or an error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const afm::fuzz::MemoryFile file(bytes, size);
  auto scene = afm::scene::load_gltf(file.path());
  if (!scene) return 0;
  ++afm::fuzz::accepted_inputs;
  afm::check(*scene);
  afm::check(afm::scene::posed(std::move(*scene), 0.5F));
  return 0;
}
