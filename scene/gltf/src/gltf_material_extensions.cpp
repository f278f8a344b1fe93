// SPDX-License-Identifier: Apache-2.0
#include "gltf_material_extensions.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "gltf_error.h"
#include "gltf_materials.h"
#include "gltf_members.h"

// A new extension needs a schema, a reader, and a row of the table at the end (docs/adding-a-gltf-extension.md).
namespace afm::scene {
namespace {

using namespace gltf_member;
using tinygltf::Value;

float number_in(const Value& object, const char* key, double missing) {
  return static_cast<float>(number_or(object, key, missing));
}

glm::vec3 color_in(const Value& object, const char* key, glm::vec3 missing) {
  if (!object.Has(key)) return missing;
  const Value& list = object.Get(key);
  return {list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble(), list.Get(2).GetNumberAsDouble()};
}

constexpr GltfMember kClearcoat[]{share("clearcoatFactor"), texture("clearcoatTexture"),
                                  share("clearcoatRoughnessFactor"), texture("clearcoatRoughnessTexture"),
                                  object("clearcoatNormalTexture", kNormalTexture)};
void read_clearcoat(const Value& coat, PbrMaterial& material, GltfWarnings& notes) {
  material.clearcoat = number_in(coat, "clearcoatFactor", 0);
  material.clearcoat_roughness = number_in(coat, "clearcoatRoughnessFactor", 0);
  read_texture(coat, "clearcoatTexture", TextureSlot::Clearcoat, material, notes);
  read_texture(coat, "clearcoatRoughnessTexture", TextureSlot::ClearcoatRoughness, material, notes);
  read_texture(coat, "clearcoatNormalTexture", TextureSlot::ClearcoatNormal, material, notes);
  if (coat.Has("clearcoatNormalTexture")) {
    material.clearcoat_normal_scale = number_in(coat.Get("clearcoatNormalTexture"), "scale", 1);
  }
}

constexpr GltfMember kStrength[]{positive("emissiveStrength", 1e6)};
void read_strength(const Value& strong, PbrMaterial& material, GltfWarnings&) {
  material.emissive *= number_in(strong, "emissiveStrength", 1);
}

constexpr GltfMember kIor[]{positive("ior")};
void read_ior(const Value& refractive, PbrMaterial& material, GltfWarnings& notes) {
  material.ior = number_in(refractive, "ior", 1.5);
  if (material.ior < 1.0F && material.ior >= 1.0F - static_cast<float>(kRounding)) {
    notes.correct(fmt::format("the ior of '{}' is {}: drawn as 1", material.name.substr(0, 60), material.ior));
    material.ior = 1.0F;
  }
  if (material.ior != 0.0F && material.ior < 1.0F) {
    throw GltfError(fmt::format("its material '{}' has an ior between 0 and 1", material.name.substr(0, 60)));
  }
}

constexpr GltfMember kIridescence[]{share("iridescenceFactor"),
                                    texture("iridescenceTexture"),
                                    number("iridescenceIor", 1).rounded(kRounding),
                                    positive("iridescenceThicknessMinimum"),
                                    positive("iridescenceThicknessMaximum"),
                                    texture("iridescenceThicknessTexture")};
void read_iridescence(const Value& film, PbrMaterial& material, GltfWarnings& notes) {
  material.iridescence = number_in(film, "iridescenceFactor", 0);
  material.iridescence_ior = number_in(film, "iridescenceIor", 1.3);
  material.iridescence_thickness_nm = {number_in(film, "iridescenceThicknessMinimum", 100),
                                       number_in(film, "iridescenceThicknessMaximum", 400)};
  read_texture(film, "iridescenceTexture", TextureSlot::Iridescence, material, notes);
  read_texture(film, "iridescenceThicknessTexture", TextureSlot::IridescenceThickness, material, notes);
}

constexpr GltfMember kSpecular[]{share("specularFactor"), texture("specularTexture"),
                                 positive("specularColorFactor").list(3, 3), texture("specularColorTexture")};
void read_specular(const Value& specular, PbrMaterial& material, GltfWarnings& notes) {
  material.specular = number_in(specular, "specularFactor", 1);
  material.specular_color = color_in(specular, "specularColorFactor", glm::vec3(1));
  read_texture(specular, "specularTexture", TextureSlot::Specular, material, notes);
  read_texture(specular, "specularColorTexture", TextureSlot::SpecularColor, material, notes);
}

constexpr GltfMaterialExtension kExtensions[]{
    {object("KHR_materials_clearcoat", kClearcoat), read_clearcoat},
    {object("KHR_materials_emissive_strength", kStrength), read_strength},
    {object("KHR_materials_ior", kIor), read_ior},
    {object("KHR_materials_iridescence", kIridescence), read_iridescence},
    {object("KHR_materials_specular", kSpecular), read_specular},
    {object("KHR_materials_unlit", {}),
     [](const Value&, PbrMaterial& material, GltfWarnings&) { material.unlit = true; }},
};
constexpr auto kSchemas = [] {
  std::array<GltfMember, std::size(kExtensions)> schemas;
  std::transform(std::begin(kExtensions), std::end(kExtensions), schemas.begin(),
                 [](const auto& e) { return e.schema; });
  return schemas;
}();

}  // namespace

std::span<const GltfMaterialExtension> gltf_material_extensions() { return kExtensions; }
std::span<const GltfMember> gltf_material_extension_members() { return kSchemas; }

}  // namespace afm::scene
