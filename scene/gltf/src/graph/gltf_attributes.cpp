// SPDX-License-Identifier: Apache-2.0
#include "graph/gltf_attributes.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "gltf_error.h"

namespace afm::scene {
namespace {

// Integer types allowed for an attribute, in addition to float.
enum class Integers { None, NormalizedUnsigned, Unsigned, Small, SmallSigned };

struct Attribute {
  std::string_view name;
  int least_components;
  int most_components;
  Integers plain;
  Integers quantized;
};

constexpr std::array<Attribute, 10> kAttributes{{
    {"POSITION", 3, 3, Integers::None, Integers::Small},
    {"NORMAL", 3, 3, Integers::None, Integers::SmallSigned},
    {"TANGENT", 4, 4, Integers::None, Integers::SmallSigned},
    {"TEXCOORD_0", 2, 2, Integers::NormalizedUnsigned, Integers::Small},
    {"TEXCOORD_1", 2, 2, Integers::NormalizedUnsigned, Integers::Small},
    {"COLOR_0", 3, 4, Integers::NormalizedUnsigned, Integers::NormalizedUnsigned},
    {"JOINTS_0", 4, 4, Integers::Unsigned, Integers::Unsigned},
    {"JOINTS_1", 4, 4, Integers::Unsigned, Integers::Unsigned},
    {"WEIGHTS_0", 4, 4, Integers::NormalizedUnsigned, Integers::NormalizedUnsigned},
    {"WEIGHTS_1", 4, 4, Integers::NormalizedUnsigned, Integers::NormalizedUnsigned},
}};

const Attribute* find(std::string_view name) {
  const auto* found =
      std::find_if(kAttributes.begin(), kAttributes.end(), [&](const Attribute& a) { return a.name == name; });
  return found == kAttributes.end() ? nullptr : found;
}

bool is_small_unsigned(const Accessor& accessor) {
  return accessor.type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
         accessor.type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT;
}

bool is_small_signed(const Accessor& accessor) {
  return accessor.type == TINYGLTF_COMPONENT_TYPE_BYTE || accessor.type == TINYGLTF_COMPONENT_TYPE_SHORT;
}

bool is_among(const Accessor& accessor, Integers integers) {
  switch (integers) {
    case Integers::None:
      return false;
    case Integers::NormalizedUnsigned:
      return is_small_unsigned(accessor) && accessor.normalized;
    case Integers::Unsigned:
      return is_small_unsigned(accessor) && !accessor.normalized;
    case Integers::Small:
      return is_small_unsigned(accessor) || is_small_signed(accessor);
    case Integers::SmallSigned:
      return is_small_signed(accessor) && accessor.normalized;
  }
  return false;
}

}  // namespace

bool uses_quantization(const tinygltf::Model& model) {
  const auto& names = model.extensionsUsed;
  return std::find(names.begin(), names.end(), "KHR_mesh_quantization") != names.end();
}

bool is_read_attribute(const std::string& name) { return find(name) != nullptr; }

void check_attribute(const std::string& path, const std::string& name, const Accessor& accessor, AttributeOwner owner,
                     bool quantized) {
  const Attribute* attribute = find(name);
  if (attribute == nullptr) return;
  // a morph target's tangent has no handedness
  const bool right_size = owner == AttributeOwner::Target ? accessor.components == 3
                                                          : accessor.components >= attribute->least_components &&
                                                                accessor.components <= attribute->most_components;
  const bool is_float = accessor.is_float() && attribute->plain != Integers::Unsigned;
  const Integers integers = quantized ? attribute->quantized : attribute->plain;
  if (accessor.matrix || !right_size || !(is_float || is_among(accessor, integers))) {
    throw GltfError(fmt::format("{} has {} of a forbidden type", path, name));
  }
}

void check_indices(const std::string& path, const Accessor& accessor) {
  const bool is_unsigned = is_small_unsigned(accessor) || accessor.type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (accessor.components != 1 || !is_unsigned || accessor.normalized) {
    throw GltfError(fmt::format("{} has indices of a forbidden type", path));
  }
}

std::uint32_t restart_index(const Accessor& accessor) {
  if (accessor.type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE) return std::numeric_limits<std::uint8_t>::max();
  if (accessor.type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) return std::numeric_limits<std::uint16_t>::max();
  return std::numeric_limits<std::uint32_t>::max();
}

}  // namespace afm::scene
