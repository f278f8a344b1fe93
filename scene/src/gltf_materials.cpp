// SPDX-License-Identifier: Apache-2.0
#include "gltf_materials.h"

#include <fmt/core.h>

#include <array>
#include <cmath>

namespace afm::scene {
namespace {

using Range = JsonElement::Range;
constexpr Range kShare{0, 1};
constexpr Range kPositive{0, 1e30};
constexpr Range kAny{-1e30, 1e30};

class MaterialReader {
 public:
  MaterialReader(const JsonElement& element, std::size_t textures, Material& material, GltfNotes& notes)
      : element_(element), textures_(textures), material_(material), notes_(notes) {}

  void read() {
    material_.name = element_.text("name", "");
    material_.double_sided = element_.flag("doubleSided", false);
    read_alpha();
    if (const auto pbr = element_.object("pbrMetallicRoughness")) read_metallic_roughness(*pbr);
    if (const auto use = read_texture(element_, "normalTexture", TextureSlot::Normal)) {
      material_.normal_scale = number(*use, "scale", 1, kAny);
    }
    if (const auto use = read_texture(element_, "occlusionTexture", TextureSlot::Occlusion)) {
      material_.occlusion_strength = number(*use, "strength", 1, kShare);
    }
    read_texture(element_, "emissiveTexture", TextureSlot::Emissive);
    material_.emissive = color(element_, "emissiveFactor", 0.0F, kShare);
    read_extensions();
  }

 private:
  static float number(const JsonElement& from, const char* key, double missing, Range range) {
    return static_cast<float>(from.number(key, missing, range));
  }

  static glm::vec3 color(const JsonElement& from, const char* key, float missing, Range range) {
    std::array<double, 3> rgb{};
    return from.numbers(key, rgb, range) ? glm::vec3(glm::dvec3(rgb[0], rgb[1], rgb[2])) : glm::vec3(missing);
  }

  void read_alpha() {
    const std::string mode = element_.text("alphaMode", "OPAQUE");
    const float cutoff = number(element_, "alphaCutoff", 0.5, kPositive);
    if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") {
      element_.fail("has an alphaMode that is not OPAQUE, MASK or BLEND");
    }
    material_.blended = mode == "BLEND";
    if (mode == "MASK") material_.alpha_cutoff = cutoff;
  }

  void read_metallic_roughness(const JsonElement& pbr) {
    std::array<double, 4> rgba{};
    if (pbr.numbers("baseColorFactor", rgba, kShare)) {
      material_.base_color = glm::vec4(glm::dvec4(rgba[0], rgba[1], rgba[2], rgba[3]));
    }
    material_.metallic = number(pbr, "metallicFactor", 1, kShare);
    material_.roughness = number(pbr, "roughnessFactor", 1, kShare);
    read_texture(pbr, "baseColorTexture", TextureSlot::BaseColor);
    read_texture(pbr, "metallicRoughnessTexture", TextureSlot::MetallicRoughness);
  }

  // Returns the texture's object where there is one.
  std::optional<JsonElement> read_texture(const JsonElement& from, const char* key, TextureSlot slot) {
    const auto info = from.object(key);
    if (!info) return std::nullopt;
    TextureUse use;
    use.texture = info->required_index("index", textures_);
    std::uint64_t set = info->size("texCoord", 0, 255);
    if (const auto transform = info->extension("KHR_texture_transform")) {
      std::array<double, 2> pair{};
      if (transform->numbers("offset", pair, kAny)) use.offset = glm::vec2(glm::dvec2(pair[0], pair[1]));
      if (transform->numbers("scale", pair, kAny)) use.scale = glm::vec2(glm::dvec2(pair[0], pair[1]));
      use.rotation_rad = number(*transform, "rotation", 0, kAny);
      set = transform->size("texCoord", set, 255);
    }
    if (set > 1) {
      notes_.ignore(fmt::format("{}: uses texture coordinates of set {}, only 0 and 1 are read", key, set));
    } else {
      use.coordinates = static_cast<std::uint32_t>(set);
      material_.texture(slot) = use;
    }
    return info;
  }

  void read_extensions() {
    material_.unlit = element_.extension("KHR_materials_unlit").has_value();
    if (const auto strong = element_.extension("KHR_materials_emissive_strength")) {
      material_.emissive *= number(*strong, "emissiveStrength", 1, {0, 1e6});
    }
    if (const auto refractive = element_.extension("KHR_materials_ior")) {
      material_.ior = number(*refractive, "ior", 1.5, kPositive);
      if (material_.ior != 0.0F && material_.ior < 1.0F) refractive->fail("has an ior between 0 and 1");
    }
    if (const auto specular = element_.extension("KHR_materials_specular")) {
      material_.specular = number(*specular, "specularFactor", 1, kShare);
      material_.specular_color = color(*specular, "specularColorFactor", 1.0F, kPositive);
      read_texture(*specular, "specularTexture", TextureSlot::Specular);
      read_texture(*specular, "specularColorTexture", TextureSlot::SpecularColor);
    }
    if (const auto coat = element_.extension("KHR_materials_clearcoat")) read_clearcoat(*coat);
    if (const auto film = element_.extension("KHR_materials_iridescence")) read_iridescence(*film);
  }

  void read_clearcoat(const JsonElement& coat) {
    material_.clearcoat = number(coat, "clearcoatFactor", 0, kShare);
    material_.clearcoat_roughness = number(coat, "clearcoatRoughnessFactor", 0, kShare);
    read_texture(coat, "clearcoatTexture", TextureSlot::Clearcoat);
    read_texture(coat, "clearcoatRoughnessTexture", TextureSlot::ClearcoatRoughness);
    if (const auto use = read_texture(coat, "clearcoatNormalTexture", TextureSlot::ClearcoatNormal)) {
      material_.clearcoat_normal_scale = number(*use, "scale", 1, kAny);
    }
  }

  void read_iridescence(const JsonElement& film) {
    material_.iridescence = number(film, "iridescenceFactor", 0, kShare);
    material_.iridescence_ior = number(film, "iridescenceIor", 1.3, {1, 1e30});
    material_.iridescence_thickness_nm = {number(film, "iridescenceThicknessMinimum", 100, kPositive),
                                          number(film, "iridescenceThicknessMaximum", 400, kPositive)};
    read_texture(film, "iridescenceTexture", TextureSlot::Iridescence);
    read_texture(film, "iridescenceThicknessTexture", TextureSlot::IridescenceThickness);
  }

  const JsonElement& element_;
  std::size_t textures_;
  Material& material_;
  GltfNotes& notes_;
};

}  // namespace

void read_materials(const JsonElement& root, Scene& scene, GltfNotes& notes) {
  const std::size_t textures = root.count("textures");
  for (const JsonElement& element : root.objects("materials")) {
    MaterialReader(element, textures, scene.materials.emplace_back(), notes).read();
  }
}

}  // namespace afm::scene
