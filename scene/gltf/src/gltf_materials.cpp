// SPDX-License-Identifier: Apache-2.0
#include "gltf_materials.h"

#include <fmt/core.h>

#include "gltf_error.h"

namespace afm::scene {
namespace {

using tinygltf::Value;

float number(const Value& object, const char* key, double missing) {
  return static_cast<float>(number_or(object, key, missing));
}

glm::vec2 pair(const Value& object, const char* key, glm::vec2 missing) {
  if (!object.Has(key)) return missing;
  const Value& list = object.Get(key);
  return glm::vec2(list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble());
}

glm::vec3 color(const Value& object, const char* key, glm::vec3 missing) {
  if (!object.Has(key)) return missing;
  const Value& list = object.Get(key);
  return {list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble(), list.Get(2).GetNumberAsDouble()};
}

class MaterialReader {
 public:
  MaterialReader(const tinygltf::Material& source, Material& material, GltfWarnings& notes)
      : source_(source), material_(material), notes_(notes) {}

  void read() {
    material_.name = source_.name;
    material_.double_sided = source_.doubleSided;
    material_.blended = source_.alphaMode == "BLEND";
    if (source_.alphaMode == "MASK") material_.alpha_cutoff = static_cast<float>(source_.alphaCutoff);
    const tinygltf::PbrMetallicRoughness& pbr = source_.pbrMetallicRoughness;
    const auto& rgba = pbr.baseColorFactor;
    material_.base_color = glm::vec4(glm::dvec4(rgba[0], rgba[1], rgba[2], rgba[3]));
    material_.metallic = static_cast<float>(pbr.metallicFactor);
    material_.roughness = static_cast<float>(pbr.roughnessFactor);
    use_texture(pbr.baseColorTexture, TextureSlot::BaseColor);
    use_texture(pbr.metallicRoughnessTexture, TextureSlot::MetallicRoughness);
    use_texture(source_.normalTexture, TextureSlot::Normal);
    material_.normal_scale = static_cast<float>(source_.normalTexture.scale);
    use_texture(source_.occlusionTexture, TextureSlot::Occlusion);
    material_.occlusion_strength = static_cast<float>(source_.occlusionTexture.strength);
    use_texture(source_.emissiveTexture, TextureSlot::Emissive);
    const auto& emissive = source_.emissiveFactor;
    material_.emissive = glm::vec3(glm::dvec3(emissive[0], emissive[1], emissive[2]));
    read_extensions();
  }

 private:
  // One of tinygltf's three kinds of reference to a texture.
  template <class Info>
  void use_texture(const Info& info, TextureSlot slot) {
    if (info.index < 0) return;
    use_texture(info.index, info.texCoord, find_extension(info.extensions, "KHR_texture_transform"), slot);
  }

  // A reference to a texture inside an extension.
  void use_texture(const Value& extension, const char* key, TextureSlot slot) {
    if (!extension.Has(key)) return;
    const Value& info = extension.Get(key);
    const Value* transform = nullptr;
    if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform")) {
      transform = &info.Get("extensions").Get("KHR_texture_transform");
    }
    use_texture(info.Get("index").GetNumberAsInt(), static_cast<int>(number_or(info, "texCoord", 0)), transform, slot);
  }

  void use_texture(int texture, int set, const Value* transform, TextureSlot slot) {
    TextureUse use;
    use.texture = static_cast<std::uint32_t>(texture);
    if (transform != nullptr) {
      use.offset = pair(*transform, "offset", use.offset);
      use.scale = pair(*transform, "scale", use.scale);
      use.rotation_rad = number(*transform, "rotation", 0);
      set = static_cast<int>(number_or(*transform, "texCoord", set));
    }
    if (set > 1) {
      notes_.ignore(
          fmt::format("a texture of '{}': has coordinates of set {}, only 0 and 1 are read", material_.name, set));
      return;
    }
    use.coordinates = static_cast<std::uint32_t>(set);
    material_.texture(slot) = use;
  }

  const Value* extension(const char* name) const { return find_extension(source_.extensions, name); }

  void read_extensions() {
    material_.unlit = extension("KHR_materials_unlit") != nullptr;
    if (const Value* strong = extension("KHR_materials_emissive_strength")) {
      material_.emissive *= number(*strong, "emissiveStrength", 1);
    }
    // KHR_materials_unlit: what else the material says is for programs that do not know the extension
    if (material_.unlit) material_.emissive = glm::vec3(0.0F);
    if (const Value* refractive = extension("KHR_materials_ior")) {
      material_.ior = number(*refractive, "ior", 1.5);
      if (material_.ior != 0.0F && material_.ior < 1.0F) {
        throw GltfError(fmt::format("its material '{}' has an ior between 0 and 1", material_.name.substr(0, 60)));
      }
    }
    if (const Value* specular = extension("KHR_materials_specular")) {
      material_.specular = number(*specular, "specularFactor", 1);
      material_.specular_color = color(*specular, "specularColorFactor", glm::vec3(1));
      use_texture(*specular, "specularTexture", TextureSlot::Specular);
      use_texture(*specular, "specularColorTexture", TextureSlot::SpecularColor);
    }
    if (const Value* coat = extension("KHR_materials_clearcoat")) {
      material_.clearcoat = number(*coat, "clearcoatFactor", 0);
      material_.clearcoat_roughness = number(*coat, "clearcoatRoughnessFactor", 0);
      use_texture(*coat, "clearcoatTexture", TextureSlot::Clearcoat);
      use_texture(*coat, "clearcoatRoughnessTexture", TextureSlot::ClearcoatRoughness);
      use_texture(*coat, "clearcoatNormalTexture", TextureSlot::ClearcoatNormal);
      if (coat->Has("clearcoatNormalTexture")) {
        material_.clearcoat_normal_scale = number(coat->Get("clearcoatNormalTexture"), "scale", 1);
      }
    }
    if (const Value* film = extension("KHR_materials_iridescence")) {
      material_.iridescence = number(*film, "iridescenceFactor", 0);
      material_.iridescence_ior = number(*film, "iridescenceIor", 1.3);
      material_.iridescence_thickness_nm = {number(*film, "iridescenceThicknessMinimum", 100),
                                            number(*film, "iridescenceThicknessMaximum", 400)};
      use_texture(*film, "iridescenceTexture", TextureSlot::Iridescence);
      use_texture(*film, "iridescenceThicknessTexture", TextureSlot::IridescenceThickness);
    }
  }

  const tinygltf::Material& source_;
  Material& material_;
  GltfWarnings& notes_;
};

}  // namespace

void read_materials(const tinygltf::Model& model, Scene& scene, GltfWarnings& notes) {
  for (const tinygltf::Material& source : model.materials) {
    MaterialReader(source, scene.materials.emplace_back(), notes).read();
  }
}

}  // namespace afm::scene
