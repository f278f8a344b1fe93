// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace afm::scene {

// Pixels as stored in the file, four bytes each, rows from top to bottom. The slot that reads them, not the image,
// determines whether they are sRGB or linear.
struct Image {
  std::string name;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
};

enum class TextureFilter { Nearest, Linear };
enum class TextureWrap { Repeat, MirroredRepeat, ClampToEdge };

// An image and how it is sampled.
struct Texture {
  std::uint32_t image = 0;
  TextureFilter magnified = TextureFilter::Linear;
  TextureFilter minified = TextureFilter::Linear;
  std::optional<TextureFilter> between_mips = TextureFilter::Linear;  // filter between mipmap levels; none: no mipmaps
  TextureWrap wrap_u = TextureWrap::Repeat;
  TextureWrap wrap_v = TextureWrap::Repeat;

  bool operator==(const Texture&) const = default;
};

// Purpose of a material's texture; each has its number in material.frag.
enum class TextureSlot : std::uint8_t {
  BaseColor,             // rgb colour, a coverage
  MetallicRoughness,     // g: roughness; b: metalness
  Normal,                // normals in tangent space
  Occlusion,             // r: ambient occlusion
  Emissive,              // rgb: emitted colour
  Specular,              // a: strength of the specular reflection
  SpecularColor,         // rgb: colour of the specular reflection
  Clearcoat,             // r: strength of the coat
  ClearcoatRoughness,    // g: roughness of the coat
  ClearcoatNormal,       // normals of the coat in tangent space
  Iridescence,           // r: strength of the iridescence
  IridescenceThickness,  // g: thickness of the film
  Count
};
inline constexpr auto kTextureSlots = static_cast<std::size_t>(TextureSlot::Count);

struct TextureSlotTraits {
  TextureSlot slot;
  std::string_view name;
  bool is_srgb = false;  // sRGB if true, linear otherwise
};

// Every slot, in the order of the enumeration.
inline constexpr std::array kTextureSlotTraits{
    TextureSlotTraits{TextureSlot::BaseColor, "BaseColor", true},
    TextureSlotTraits{TextureSlot::MetallicRoughness, "MetallicRoughness"},
    TextureSlotTraits{TextureSlot::Normal, "Normal"},
    TextureSlotTraits{TextureSlot::Occlusion, "Occlusion"},
    TextureSlotTraits{TextureSlot::Emissive, "Emissive", true},
    TextureSlotTraits{TextureSlot::Specular, "Specular"},
    TextureSlotTraits{TextureSlot::SpecularColor, "SpecularColor", true},
    TextureSlotTraits{TextureSlot::Clearcoat, "Clearcoat"},
    TextureSlotTraits{TextureSlot::ClearcoatRoughness, "ClearcoatRoughness"},
    TextureSlotTraits{TextureSlot::ClearcoatNormal, "ClearcoatNormal"},
    TextureSlotTraits{TextureSlot::Iridescence, "Iridescence"},
    TextureSlotTraits{TextureSlot::IridescenceThickness, "IridescenceThickness"},
};
static_assert(kTextureSlotTraits.size() == kTextureSlots, "a slot has no row");
static_assert([] {
  for (std::size_t i = 0; i < kTextureSlots; ++i) {
    if (kTextureSlotTraits[i].slot != static_cast<TextureSlot>(i)) return false;
  }
  return true;
}());

// Texture coordinates of one texture of a material: set 0 or 1, scaled, rotated and shifted in this order
// (KHR_texture_transform).
struct TextureUse {
  std::optional<std::uint32_t> texture;
  std::uint32_t coordinates = 0;
  glm::vec2 offset{0.0F};
  glm::vec2 scale{1.0F};
  float rotation_rad = 0.0F;

  bool operator==(const TextureUse&) const = default;
};

// Appearance of a surface: glTF 2.0 metallic-roughness factors, linear, and those of the supported KHR_materials
// extensions.
struct PbrMaterial {
  std::string name;
  glm::vec4 base_color{1.0F};
  glm::vec3 emissive{0.0F};  // emitted light, including KHR_materials_emissive_strength
  float metallic = 1.0F;
  float roughness = 1.0F;
  bool double_sided = false;
  bool blended = false;  // alphaMode BLEND: drawn after the opaque primitives, writes no depth, casts no shadow
  bool unlit = false;    // KHR_materials_unlit
  std::optional<float> alpha_cutoff{};  // alphaMode MASK: fragments with less coverage are discarded
  float normal_scale = 1.0F;
  float occlusion_strength = 1.0F;
  float ior = 1.5F;       // KHR_materials_ior
  float specular = 1.0F;  // KHR_materials_specular
  glm::vec3 specular_color{1.0F};
  float clearcoat = 0.0F;  // KHR_materials_clearcoat
  float clearcoat_roughness = 0.0F;
  float clearcoat_normal_scale = 1.0F;
  float iridescence = 0.0F;  // KHR_materials_iridescence
  float iridescence_ior = 1.3F;
  glm::vec2 iridescence_thickness_nm{100.0F, 400.0F};  // at texture values 0 and 1; without texture: the second
  std::array<TextureUse, kTextureSlots> textures{};

  const TextureUse& texture(TextureSlot slot) const { return textures[static_cast<std::size_t>(slot)]; }
  TextureUse& texture(TextureSlot slot) { return textures[static_cast<std::size_t>(slot)]; }
};

// Shaders that use a field. Plain materials are those that the shader without textures can draw: every Extended and
// Feature field has its default.
enum class PbrUse {
  Plain,     // drawn by every shader, or by a texture with its own bit
  Factor,    // read only by material.frag; no effect without a texture or a feature
  Extended,  // values other than the default are drawn only by material.frag
  Feature,   // values other than the default enable a part of material.frag; 0: off
};

template <class T>
struct PbrField {
  T PbrMaterial::* member;
  std::string_view name;
  PbrUse use;
};

// Every field, in the order of the struct; scene_digest.cpp does not compile if one is missing. These rows determine
// the digest, the shader that draws a material, and the shader's input: all fields but Plain are the first members of
// material.frag's block, in this order and with these names, and the features are its bits.
inline constexpr std::tuple kPbrFields{
    PbrField{&PbrMaterial::name, "name", PbrUse::Plain},
    PbrField{&PbrMaterial::base_color, "base_color", PbrUse::Plain},
    PbrField{&PbrMaterial::emissive, "emissive", PbrUse::Plain},
    PbrField{&PbrMaterial::metallic, "metallic", PbrUse::Plain},
    PbrField{&PbrMaterial::roughness, "roughness", PbrUse::Plain},
    PbrField{&PbrMaterial::double_sided, "double_sided", PbrUse::Plain},
    PbrField{&PbrMaterial::blended, "blended", PbrUse::Plain},
    PbrField{&PbrMaterial::unlit, "unlit", PbrUse::Plain},
    PbrField{&PbrMaterial::alpha_cutoff, "alpha_cutoff", PbrUse::Extended},
    PbrField{&PbrMaterial::normal_scale, "normal_scale", PbrUse::Factor},
    PbrField{&PbrMaterial::occlusion_strength, "occlusion_strength", PbrUse::Factor},
    PbrField{&PbrMaterial::ior, "ior", PbrUse::Extended},
    PbrField{&PbrMaterial::specular, "specular", PbrUse::Extended},
    PbrField{&PbrMaterial::specular_color, "specular_color", PbrUse::Extended},
    PbrField{&PbrMaterial::clearcoat, "clearcoat", PbrUse::Feature},
    PbrField{&PbrMaterial::clearcoat_roughness, "clearcoat_roughness", PbrUse::Factor},
    PbrField{&PbrMaterial::clearcoat_normal_scale, "clearcoat_normal_scale", PbrUse::Factor},
    PbrField{&PbrMaterial::iridescence, "iridescence", PbrUse::Feature},
    PbrField{&PbrMaterial::iridescence_ior, "iridescence_ior", PbrUse::Factor},
    PbrField{&PbrMaterial::iridescence_thickness_nm, "iridescence_thickness_nm", PbrUse::Factor},
    PbrField{&PbrMaterial::textures, "textures", PbrUse::Plain},
};

template <class Visit>
constexpr void for_each_pbr_field(Visit visit) {
  std::apply([&](const auto&... field) { (visit(field), ...); }, kPbrFields);
}

}  // namespace afm::scene
