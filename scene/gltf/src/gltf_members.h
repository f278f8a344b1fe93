// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gltf_schema.h"

// Vocabulary for the schema's tables.
namespace afm::scene::gltf_member {

using Members = std::span<const GltfMember>;
using Kind = GltfMember::Kind;

// Limit on the length of a list: tinygltf's elements take up to two kilobytes each.
inline constexpr std::size_t kMany = 250'000;
inline constexpr std::size_t kMostMaterials = 16'384;
inline constexpr double kLargest = 1e30;

constexpr GltfMember text(std::string_view name) { return {name, Kind::Text}; }
constexpr GltfMember flag(std::string_view name) { return {name, Kind::Flag}; }
constexpr GltfMember choice(std::string_view name, std::string_view choices) {
  return {name, Kind::Choice, 0, 0, choices};
}
constexpr GltfMember number(std::string_view name, double low = -kLargest, double high = kLargest) {
  return {name, Kind::Number, low, high};
}
constexpr GltfMember whole(std::string_view name, double low, double high) { return {name, Kind::Whole, low, high}; }
constexpr GltfMember index(std::string_view name, GltfList into) { return {name, Kind::Index, 0, 0, {}, into}; }
constexpr GltfMember object(std::string_view name, Members members) {
  return {name, Kind::Object, 0, 0, {}, {}, members};
}
constexpr GltfMember accessors(std::string_view name) { return {name, Kind::Accessors}; }
// Largest overshoot of a factor in 0 to 1 that is drawn as the limit.
inline constexpr double kRounding = 0.01;
constexpr GltfMember share(std::string_view name) { return number(name, 0, 1).rounded(kRounding); }
constexpr GltfMember positive(std::string_view name, double high = kLargest) {
  return number(name, 0, high).rounded(kRounding);
}
constexpr GltfMember above_zero(std::string_view name) { return number(name, 1e-30); }

inline constexpr GltfMember kTransform[]{number("offset").list(2, 2), number("rotation"), number("scale").list(2, 2),
                                         whole("texCoord", 0, 255)};
inline constexpr GltfMember kTextureExtensions[]{object("KHR_texture_transform", kTransform)};
inline constexpr GltfMember kTextureIndex = index("index", GltfList::Textures).required();
inline constexpr GltfMember kTextureInfo[]{kTextureIndex, whole("texCoord", 0, 255),
                                           object("extensions", kTextureExtensions)};
inline constexpr GltfMember kNormalTexture[]{kTextureIndex, whole("texCoord", 0, 255), number("scale"),
                                             object("extensions", kTextureExtensions)};
inline constexpr GltfMember kOcclusionTexture[]{kTextureIndex, whole("texCoord", 0, 255), share("strength"),
                                                object("extensions", kTextureExtensions)};
constexpr GltfMember texture(std::string_view name) { return object(name, kTextureInfo); }

}  // namespace afm::scene::gltf_member
