// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <type_traits>

// Copies between a record of the program and its form in a message or file. A function that takes either
// direction as `copy` names each pair of fields once:
//
//   template <class Copy, class Ours, class Sent>
//   void copy_wand(const Copy& copy, Ours& wand, Sent& sent) {
//     copy(wand.position_m, sent.position_m);
//     copy.flag(wand.connected, sent.flags, Sent::kConnected);
//     ...
namespace afm::scene {

template <class Value>
void convert(const Value& from, Value& to) {
  to = from;
}
inline void convert(const glm::dvec3& from, std::array<double, 3>& to) { to = {from.x, from.y, from.z}; }
inline void convert(const std::array<double, 3>& from, glm::dvec3& to) { to = {from[0], from[1], from[2]}; }
// order: w, x, y, z
inline void convert(const glm::dquat& from, std::array<double, 4>& to) { to = {from.w, from.x, from.y, from.z}; }
inline void convert(const std::array<double, 4>& from, glm::dquat& to) { to = {from[0], from[1], from[2], from[3]}; }
// order: column by column
inline void convert(const glm::dmat4& from, std::array<double, 16>& to) {
  std::copy_n(glm::value_ptr(from), to.size(), to.begin());
}
inline void convert(const std::array<double, 16>& from, glm::dmat4& to) { to = glm::make_mat4(from.data()); }
// an index, or -1 for none
inline void convert(const std::optional<std::size_t>& from, std::int32_t& to) {
  to = from ? static_cast<std::int32_t>(*from) : -1;
}
inline void convert(std::int32_t from, std::optional<std::size_t>& to) {
  to = from < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(from));
}
// Values were checked when they were read: enumerators are valid, and no index is too large.
template <class Value>
concept EnumOrIndex = std::is_enum_v<Value> || std::is_same_v<Value, std::size_t> || std::is_same_v<Value, bool>;
template <EnumOrIndex Value>
void convert(Value from, std::uint32_t& to) {
  to = static_cast<std::uint32_t>(from);
}
template <EnumOrIndex Value>
void convert(std::uint32_t from, Value& to) {
  to = static_cast<Value>(from);
}

// From the program's record.
struct CopyOut {
  template <class Ours, class Theirs>
  void operator()(const Ours& ours, Theirs& theirs) const {
    convert(ours, theirs);
  }
  void flag(bool ours, std::uint32_t& flags, std::uint32_t bit) const { flags |= ours ? bit : 0U; }
  // True if there is a value, whose fields follow.
  template <class Value>
  bool has(const std::optional<Value>& ours, std::uint32_t& flags, std::uint32_t bit) const {
    flag(ours.has_value(), flags, bit);
    return ours.has_value();
  }
  template <class Value, class Theirs>
  bool has(const std::optional<Value>& ours, std::optional<Theirs>& theirs) const {
    if (ours) theirs.emplace();
    return ours.has_value();
  }
};

// Into the program's record, which is new.
struct CopyBack {
  template <class Ours, class Theirs>
  void operator()(Ours& ours, const Theirs& theirs) const {
    convert(theirs, ours);
  }
  void flag(bool& ours, std::uint32_t flags, std::uint32_t bit) const { ours = (flags & bit) != 0; }
  template <class Value>
  bool has(std::optional<Value>& ours, std::uint32_t flags, std::uint32_t bit) const {
    if ((flags & bit) != 0) ours.emplace();
    return ours.has_value();
  }
  template <class Value, class Theirs>
  bool has(std::optional<Value>& ours, const std::optional<Theirs>& theirs) const {
    if (theirs) ours.emplace();
    return ours.has_value();
  }
};

}  // namespace afm::scene
