// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string_view>

namespace afm::scene {

// Limit on the total size of a model and its side files.
inline constexpr std::uint64_t kLargestGltfBytes = 256ULL << 20U;

// Lists of a model that other parts refer to.
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

// Legal values of a member of a JSON object: glTF 2.0's schema, with our limits.
struct GltfMember {
  enum class Kind {
    Text,
    Choice,     // one of `choices`, separated by spaces; text or integer
    Flag,       // true or false
    Number,     // finite, from `low` to `high`
    Whole,      // integer from `low` to `high`
    Index,      // existing element of `into`
    Object,     // object with `members`
    Accessors,  // object whose members, of any name, are indices of accessors
    Numbers,    // object whose members, of any name, are integers up to `high`
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
  std::size_t least_elements = 0;  // shortest list
  std::size_t most_elements = 0;
  std::string_view needs{};   // required member of the same object
  std::string_view bars{};    // excluded members of the same object, separated by spaces
  double slack = 0.0;         // overshoot of `low` or `high` up to which a number becomes the limit, with a note
  bool is_our_limit = false;  // true: glTF 2.0 allows more than `high`
  bool clamps_above = false;  // true: any number above `high` becomes `high`, with a note

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
  // Tolerance for exporters that round, or convert from float.
  constexpr GltfMember rounded(double distance) const {
    GltfMember copy = *this;
    copy.slack = distance;
    return copy;
  }
  constexpr GltfMember by_our_limit() const {
    GltfMember copy = *this;
    copy.is_our_limit = true;
    return copy;
  }
  constexpr GltfMember clamped_above() const {
    GltfMember copy = *this;
    copy.clamps_above = true;
    return copy;
  }
  // List of values of this kind.
  constexpr GltfMember list(std::size_t least, std::size_t most) const {
    GltfMember copy = *this;
    copy.is_list = true;
    copy.least_elements = least;
    copy.most_elements = most;
    return copy;
  }
};

// Members checked before all others: `asset` and the lists of extensions.
std::span<const GltfMember> gltf_header();

// Document without its header, with all supported extensions.
std::span<const GltfMember> gltf_document();

// Names of the supported extensions.
std::set<std::string_view> gltf_extensions();

}  // namespace afm::scene
