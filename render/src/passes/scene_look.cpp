// SPDX-License-Identifier: Apache-2.0
#include "passes/scene_look.h"

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

std::optional<SceneLook> look_of(const scene::Scene& scene, const scene::Primitive& primitive) {
  const scene::Material& material = scene.materials.at(primitive.material);
  std::uint32_t textures = 0;
  for (std::size_t slot = 0; slot < scene::kTextureSlots && !primitive.texture_coordinates.empty(); ++slot) {
    textures |= material.textures[slot].texture ? 1U << slot : 0U;
  }
  if (is_plain(scene, primitive, material, textures)) {
    return std::nullopt;
  }
  SceneLook look{.bits = textures, .blended = material.blended, .topology = primitive.topology};
  const auto add = [&](bool wanted, std::uint32_t bit) { look.bits |= wanted ? bit : 0U; };
  add(!primitive.tangents.empty(), AFM_LOOK_TANGENTS);
  add(material.unlit || primitive.normals == scene::Normals::None, AFM_LOOK_UNLIT);
  add(material.alpha_cutoff.has_value(), AFM_LOOK_MASK);
  add(material.blended, AFM_LOOK_BLEND);
  add(material.clearcoat > 0.0F, AFM_LOOK_CLEARCOAT);
  add(material.iridescence > 0.0F, AFM_LOOK_IRIDESCENCE);
  add(!scene.lights.empty(), AFM_LOOK_LIGHTS);
  add(material.double_sided, AFM_LOOK_DOUBLE_SIDED);
  return look;
}

std::size_t count_looks(const scene::Scene& scene) {
  std::set<std::tuple<std::uint32_t, bool, scene::Topology>> looks;
  for (const scene::Mesh& mesh : scene.meshes) {
    for (const scene::Primitive& primitive : mesh.primitives) {
      if (const auto look = look_of(scene, primitive)) looks.emplace(look->bits, look->blended, look->topology);
    }
  }
  return looks.size();
}

}  // namespace afm::render
