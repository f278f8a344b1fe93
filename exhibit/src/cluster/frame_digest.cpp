// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/frame_digest.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/fnv1a.h"
#include "core/members.h"

namespace afm::exhibit {

namespace {

template <class Value>
constexpr bool kIsArray = false;
template <class Value, std::size_t count>
constexpr bool kIsArray<std::array<Value, count>> = true;

// Hashes a struct with all its members, so that none can be forgotten. Eight bytes at a time, because a frame has some
// 20 kB of transforms.
class FrameHash {
 public:
  template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
  void add(Number number) {
    std::uint64_t word = 0;
    std::memcpy(&word, &number, sizeof(number));
    value_ = (value_ ^ word) * 0x9E3779B97F4A7C15ULL;
    value_ ^= value_ >> 29U;
  }
  void add(const std::string& text) {
    add(text.size());
    add(core::fnv1a(text));
  }
  template <glm::length_t length, class Number>
  void add(const glm::vec<length, Number>& v) {
    for (glm::length_t i = 0; i < length; ++i) add(v[i]);
  }
  void add(const glm::dmat4& m) {
    for (glm::length_t column = 0; column < 4; ++column) add(m[column]);
  }
  template <class Value>
  void add(const std::optional<Value>& value) {
    add(value.has_value());
    if (value) add(*value);
  }
  template <class Value>
  void add(const std::vector<Value>& values) {
    add(values.size());
    for (const Value& value : values) add(value);
  }
  template <class Value, std::size_t count>
  void add(const std::array<Value, count>& values) {
    for (const Value& value : values) add(value);
  }
  template <class Struct>
    requires std::is_aggregate_v<Struct> && (!kIsArray<Struct>)
  void add(const Struct& members) {
    core::for_each_member([this](const auto& member) { this->add(member); }, members);
  }

  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 1;
};

}  // namespace

std::uint64_t digest_of(const render::FrameState& frame, const cluster::ShownView& view) {
  const std::array<const void*, 2> own{&frame.eyes, &frame.panels_apart};  // fields decided separately by each machine
  FrameHash hash;
  core::for_each_member(
      [&](const auto& member) {
        if (std::find(own.begin(), own.end(), static_cast<const void*>(&member)) == own.end()) hash.add(member);
      },
      frame);
  hash.add(view);
  return hash.value();
}

}  // namespace afm::exhibit
