// SPDX-License-Identifier: Apache-2.0
#include "drawing/shader_variant.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "device/shader_interface.h"
#include "support/places.h"

namespace afm::render {
namespace shader_variant_test {

using scene::PbrMaterial;
using scene::PbrUse;

void change(bool& flag) { flag = !flag; }
void change(float& number) { number += 0.25F; }
void change(std::string& text) { text += "x"; }
void change(std::optional<float>& number) { number = 0.5F; }
void change(glm::vec2& v) { v.x += 0.25F; }
void change(glm::vec3& v) { v.x += 0.25F; }
void change(glm::vec4& v) { v.x -= 0.25F; }
void change(std::array<scene::TextureUse, scene::kTextureSlots>& textures) { textures.back().rotation_rad = 1.0F; }

std::optional<ShaderVariant> variant(const PbrMaterial& material) {
  scene::Scene scene;
  scene.materials.push_back(material);
  return variant_of(scene, {});
}

TEST(ShaderVariants, ArePlainWithoutAFieldThatOnlyTheMaterialShaderDraws) {
  EXPECT_FALSE(variant({}));
  int extended = 0;
  scene::for_each_pbr_field([&](const auto& field) {
    PbrMaterial material;
    change(material.*field.member);
    const bool wanted = field.use == PbrUse::Extended || field.use == PbrUse::Feature;
    EXPECT_EQ(variant(material).has_value(), wanted) << field.name;
    extended += wanted ? 1 : 0;
  });
  EXPECT_GE(extended, 6);
}

TEST(ShaderVariants, HaveABitForEachFeature) {
  std::vector<std::uint32_t> bits;
  scene::for_each_pbr_field([&](const auto& field) {
    PbrMaterial material;
    change(material.*field.member);
    if (field.use != PbrUse::Feature) return;
    EXPECT_EQ(variant(material)->bits, 1U << (AFM_FIRST_PBR_FEATURE + bits.size())) << field.name;
    bits.push_back(variant(material)->bits);
  });
  EXPECT_GE(bits.size(), 2U);
}

std::string material_shader() {
  std::ifstream file(support::source("shaders/material.frag"));
  return {std::istreambuf_iterator<char>(file), {}};
}

// The first group of every match behind `begin` and before the next `end`.
std::vector<std::string> names_in(const std::string& text, const std::string& begin, const std::string& end,
                                  const std::string& pattern) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return {};
  const std::string part = text.substr(at, text.find(end, at) - at);
  const std::regex name(pattern);
  std::vector<std::string> names;
  for (std::sregex_iterator match(part.begin(), part.end(), name), none; match != none; ++match) {
    names.push_back((*match)[1]);
  }
  return names;
}

TEST(MaterialShader, HasTheFieldsOfTheTable) {
  std::vector<std::string> fields;
  scene::for_each_pbr_field([&](const auto& field) {
    if (field.use != PbrUse::Plain) fields.emplace_back(field.name);
  });
  EXPECT_EQ(names_in(material_shader(), "uniform Material {", "vec4 uv_rows", "vec4 (\\w+);"), fields);
}

TEST(MaterialShader, HasTheTextureSlotsOfTheTable) {
  std::vector<std::string> slots;
  for (const scene::TextureSlotTraits& traits : scene::kTextureSlotTraits) {
    slots.push_back("k" + std::string(traits.name) + " = " + std::to_string(slots.size()));
  }
  const std::string shader = material_shader();
  EXPECT_EQ(names_in(shader, "const int kBaseColor", ";", "(\\w+ = \\d+)"), slots);
  EXPECT_EQ(names_in(shader, "const int kTextureSlots", ";", "(\\d+)"), std::vector{std::to_string(slots.size())});
}

TEST(MaterialShader, HasTheFeaturesOfTheTable) {
  std::vector<std::string> features;
  scene::for_each_pbr_field([&](const auto& field) {
    if (field.use != PbrUse::Feature) return;
    std::string name;
    bool upper = true;
    for (const char letter : field.name) {
      if (letter != '_') name += static_cast<char>(upper ? std::toupper(letter) : letter);
      upper = letter == '_';
    }
    features.push_back("k" + name + "Feature = " + std::to_string(features.size()));
  });
  EXPECT_EQ(names_in(material_shader(), "const int kClearcoatFeature", ";", "(\\w+ = \\d+)"), features);
}

}  // namespace shader_variant_test
}  // namespace afm::render
