// SPDX-License-Identifier: Apache-2.0
#include "passes/shader_variant.h"

#include <set>
#include <tuple>

#include "device/shader_interface.h"

namespace afm::render {
namespace {

bool is_plain(const scene::Scene& scene, const scene::Primitive& primitive, const scene::Material& material,
              std::uint32_t textures) {
  const bool default_specular =
      material.ior == 1.5F && material.specular == 1.0F && material.specular_color == glm::vec3(1.0F);
  return textures == 0 && default_specular && !material.alpha_cutoff && material.clearcoat == 0.0F &&
         material.iridescence == 0.0F && primitive.topology == scene::Topology::Triangles &&
         (scene.lights.empty() || material.unlit);
}

}  // namespace

std::optional<ShaderVariant> variant_of(const scene::Scene& scene, const scene::Primitive& primitive) {
  const scene::Material& material = scene.materials.at(primitive.material);
  std::uint32_t textures = 0;
  for (std::size_t slot = 0; slot < scene::kTextureSlots && !primitive.texture_coordinates.empty(); ++slot) {
    textures |= material.textures[slot].texture ? 1U << slot : 0U;
  }
  if (is_plain(scene, primitive, material, textures)) {
    return std::nullopt;
  }
  ShaderVariant variant{.bits = textures, .blended = material.blended, .topology = primitive.topology};
  const auto add = [&](bool wanted, std::uint32_t bit) { variant.bits |= wanted ? bit : 0U; };
  add(!primitive.tangents.empty(), AFM_FEATURE_TANGENTS);
  add(material.unlit || primitive.normals == scene::Normals::None, AFM_FEATURE_UNLIT);
  add(material.alpha_cutoff.has_value(), AFM_FEATURE_MASK);
  add(material.blended, AFM_FEATURE_BLEND);
  add(material.clearcoat > 0.0F, AFM_FEATURE_CLEARCOAT);
  add(material.iridescence > 0.0F, AFM_FEATURE_IRIDESCENCE);
  add(!scene.lights.empty(), AFM_FEATURE_LIGHTS);
  add(material.double_sided, AFM_FEATURE_DOUBLE_SIDED);
  return variant;
}

std::size_t count_variants(const scene::Scene& scene) {
  std::set<std::tuple<std::uint32_t, bool, scene::Topology>> variants;
  for (const scene::Mesh& mesh : scene.meshes) {
    for (const scene::Primitive& primitive : mesh.primitives) {
      if (const auto variant = variant_of(scene, primitive))
        variants.emplace(variant->bits, variant->blended, variant->topology);
    }
  }
  return variants.size();
}

}  // namespace afm::render
