// SPDX-License-Identifier: Apache-2.0
#include "gltf_materials.h"

#include <fmt/core.h>

#include <string>

#include "gltf_material_extensions.h"

namespace afm::scene {
namespace {

using tinygltf::Value;

glm::vec2 pair(const Value& object, const char* key, glm::vec2 missing) {
  if (!object.Has(key)) return missing;
  const Value& list = object.Get(key);
  return glm::vec2(list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble());
}

void use_texture(int texture, int set, const Value* transform, TextureSlot slot, PbrMaterial& material,
                 GltfWarnings& notes) {
  TextureUse use;
  use.texture = static_cast<std::uint32_t>(texture);
  if (transform != nullptr) {
    use.offset = pair(*transform, "offset", use.offset);
    use.scale = pair(*transform, "scale", use.scale);
    use.rotation_rad = static_cast<float>(number_or(*transform, "rotation", 0));
    set = static_cast<int>(number_or(*transform, "texCoord", set));
  }
  if (set > 1) {
    notes.ignore(
        fmt::format("a texture of '{}': has coordinates of set {}, only 0 and 1 are read", material.name, set));
    return;
  }
  use.coordinates = static_cast<std::uint32_t>(set);
  material.texture(slot) = use;
}

class MaterialReader {
 public:
  MaterialReader(const tinygltf::Material& source, PbrMaterial& material, GltfWarnings& notes)
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
    for (const GltfMaterialExtension& extension : gltf_material_extensions()) {
      const Value* value = find_extension(source_.extensions, std::string(extension.schema.name));
      if (value != nullptr) extension.read(*value, material_, notes_);
    }
    // KHR_materials_unlit: the other properties are for programs without the extension
    if (material_.unlit) material_.emissive = glm::vec3(0.0F);
  }

 private:
  // Converts one of tinygltf's three kinds of texture reference.
  template <class Info>
  void use_texture(const Info& info, TextureSlot slot) {
    if (info.index < 0) return;
    const Value* transform = find_extension(info.extensions, "KHR_texture_transform");
    scene::use_texture(info.index, info.texCoord, transform, slot, material_, notes_);
  }

  const tinygltf::Material& source_;
  PbrMaterial& material_;
  GltfWarnings& notes_;
};

}  // namespace

void read_texture(const Value& extension, const char* key, TextureSlot slot, PbrMaterial& material,
                  GltfWarnings& notes) {
  if (!extension.Has(key)) return;
  const Value& info = extension.Get(key);
  const Value* transform = nullptr;
  if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform")) {
    transform = &info.Get("extensions").Get("KHR_texture_transform");
  }
  use_texture(info.Get("index").GetNumberAsInt(), static_cast<int>(number_or(info, "texCoord", 0)), transform, slot,
              material, notes);
}

void read_materials(const tinygltf::Model& model, Scene& scene, GltfWarnings& notes) {
  for (const tinygltf::Material& source : model.materials) {
    MaterialReader(source, scene.materials.emplace_back(), notes).read();
  }
}

}  // namespace afm::scene
