// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string_view>

namespace afm::scene {

// A model and all its side files together.
inline constexpr std::uint64_t kLargestGltfBytes = 256ULL << 20U;

// The lists of a model that its other parts refer into.
enum class GltfList {
  Accessors,
  Buffers,
  BufferViews,
  Cameras,
  Images,
  Lights,
  Materials,
  Meshes,
  Nodes,
  Samplers,
  Scenes,
  Skins,
  Textures,
  Variants
};
inline constexpr std::size_t kGltfLists = 14;

// Legal values of a member of a JSON object: glTF 2.0's schema, with our bounds.
struct GltfMember {
  enum class Kind {
    Text,
    Choice,     // one of `choices`, separated by spaces; a text, or a whole number
    Flag,       // true or false
    Number,     // finite, from `low` to `high`
    Whole,      // the same without a fraction
    Index,      // of an element of `into` that exists
    Object,     // with `members`
    Accessors,  // an object whose members, of any name, are indices of accessors
    Numbers,    // an object whose members, of any name, are whole numbers up to `high`
  };

  std::string_view name;
  Kind kind = Kind::Text;
  double low = 0.0;
  double high = 0.0;
  std::string_view choices{};
  GltfList into{};
  std::span<const GltfMember> members{};
  bool is_required = false;
  bool is_list = false;
  std::size_t least_elements = 0;  // of a list
  std::size_t most_elements = 0;
  std::string_view needs{};  // the member that must stand beside it
  std::string_view bars{};   // and those that may not, separated by spaces

  constexpr GltfMember required() const {
    GltfMember copy = *this;
    copy.is_required = true;
    return copy;
  }
  constexpr GltfMember with(std::string_view beside) const {
    GltfMember copy = *this;
    copy.needs = beside;
    return copy;
  }
  constexpr GltfMember without(std::string_view beside) const {
    GltfMember copy = *this;
    copy.bars = beside;
    return copy;
  }
  // A list of such values.
  constexpr GltfMember list(std::size_t least, std::size_t most) const {
    GltfMember copy = *this;
    copy.is_list = true;
    copy.least_elements = least;
    copy.most_elements = most;
    return copy;
  }
};

// Members to check before all others: `asset` and the lists of extensions.
std::span<const GltfMember> gltf_header();

// All of a document but its header, with the extensions that are understood.
std::span<const GltfMember> gltf_document();

// The names of those extensions.
std::set<std::string_view> gltf_extensions();

}  // namespace afm::scene
