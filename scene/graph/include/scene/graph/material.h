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
#include <vector>

namespace afm::scene {

// Pixels as the file holds them, four bytes each, rows from top to bottom. Whether they are sRGB or linear is said by
// the slot that reads them, not by the image.
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
  std::optional<TextureFilter> between_mips = TextureFilter::Linear;  // none: the image has no mipmaps
  TextureWrap wrap_u = TextureWrap::Repeat;
  TextureWrap wrap_v = TextureWrap::Repeat;

  bool operator==(const Texture&) const = default;
};

// What a texture of a material is for. The first, the emissive and the specular colours are sRGB, the others linear.
enum class TextureSlot : std::uint8_t {
  BaseColor,             // rgb colour, a coverage
  MetallicRoughness,     // g roughness, b metalness
  Normal,                // tangent space
  Occlusion,             // r
  Emissive,              // rgb
  Specular,              // a
  SpecularColor,         // rgb
  Clearcoat,             // r
  ClearcoatRoughness,    // g
  ClearcoatNormal,       // tangent space
  Iridescence,           // r
  IridescenceThickness,  // g
};
inline constexpr std::size_t kTextureSlots = 12;

constexpr bool is_srgb(TextureSlot slot) {
  return slot == TextureSlot::BaseColor || slot == TextureSlot::Emissive || slot == TextureSlot::SpecularColor;
}

// How a material reads one of its textures: coordinates of set 0 or 1, scaled, turned and shifted in this order
// (KHR_texture_transform).
struct TextureUse {
  std::optional<std::uint32_t> texture;
  std::uint32_t coordinates = 0;
  glm::vec2 offset{0.0F};
  glm::vec2 scale{1.0F};
  float rotation_rad = 0.0F;
};

// glTF 2.0 metallic-roughness factors, linear, and those of the KHR_materials extensions that are drawn.
struct Material {
  std::string name;
  glm::vec4 base_color{1.0F};
  glm::vec3 emissive{0.0F};  // KHR_materials_emissive_strength included
  float metallic = 1.0F;
  float roughness = 1.0F;
  bool double_sided = false;
  bool blended = false;  // alphaMode BLEND: drawn after the opaque primitives, writes no depth, casts no shadow
  bool unlit = false;    // KHR_materials_unlit
  std::optional<float> alpha_cutoff{};  // alphaMode MASK: what covers less is not there
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
  glm::vec2 iridescence_thickness_nm{100.0F, 400.0F};  // of a texture's 0 and 1; without a texture the second holds
  std::array<TextureUse, kTextureSlots> textures{};

  const TextureUse& texture(TextureSlot slot) const { return textures[static_cast<std::size_t>(slot)]; }
  TextureUse& texture(TextureSlot slot) { return textures[static_cast<std::size_t>(slot)]; }
};

}  // namespace afm::scene
