// SPDX-License-Identifier: Apache-2.0
#include "drawing/shader_variant.h"

#include <set>
#include <tuple>
#include <type_traits>

#include "device/shader_interface.h"

namespace afm::render {
namespace {

using scene::PbrUse;

constexpr std::size_t kFeatures = [] {
  std::size_t count = 0;
  scene::for_each_pbr_field([&](const auto& field) { count += field.use == PbrUse::Feature ? 1U : 0U; });
  return count;
}();
static_assert(scene::kTextureSlots <= AFM_FIRST_PBR_FEATURE && kFeatures <= AFM_MOST_PBR_FEATURES &&
              1U << (AFM_FIRST_PBR_FEATURE + AFM_MOST_PBR_FEATURES) <= AFM_FEATURE_TANGENTS);

bool is_plain(const scene::PbrMaterial& material) {
  static const scene::PbrMaterial plain;
  bool same = true;
  scene::for_each_pbr_field([&](const auto& field) {
    const bool matters = field.use == PbrUse::Extended || field.use == PbrUse::Feature;
    same = same && (!matters || material.*field.member == plain.*field.member);
  });
  return same;
}

// Bits of the material's features.
std::uint32_t features_of(const scene::PbrMaterial& material) {
  std::uint32_t bits = 0, bit = 1U << AFM_FIRST_PBR_FEATURE;
  scene::for_each_pbr_field([&](const auto& field) {
    if constexpr (std::is_same_v<decltype(field), const scene::PbrField<float>&>) {
      if (field.use == PbrUse::Feature) {
        bits |= material.*field.member > 0.0F ? bit : 0U;
        bit <<= 1U;
      }
    }
  });
  return bits;
}

}  // namespace

std::optional<ShaderVariant> variant_of(const scene::Scene& scene, const scene::Primitive& primitive) {
  const scene::PbrMaterial& material = scene.materials.at(primitive.material);
  std::uint32_t textures = 0;
  for (std::size_t slot = 0; slot < scene::kTextureSlots && !primitive.texture_coordinates.empty(); ++slot) {
    textures |= material.textures[slot].texture ? 1U << slot : 0U;
  }
  const bool is_lit_by_scene = !scene.lights.empty() && !material.unlit;
  if (textures == 0 && is_plain(material) && primitive.topology == scene::Topology::Triangles && !is_lit_by_scene) {
    return std::nullopt;
  }
  ShaderVariant variant{
      .bits = textures | features_of(material), .blended = material.blended, .topology = primitive.topology};
  const auto add = [&](bool wanted, std::uint32_t bit) { variant.bits |= wanted ? bit : 0U; };
  add(!primitive.tangents.empty(), AFM_FEATURE_TANGENTS);
  add(material.unlit || primitive.normals == scene::Normals::None, AFM_FEATURE_UNLIT);
  add(material.alpha_cutoff.has_value(), AFM_FEATURE_MASK);
  add(material.blended, AFM_FEATURE_BLEND);
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
