// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "physics/quantity_text.h"
#include "scene/config/toml_file.h"
#include "scene/display/wall.h"

namespace afm::scene {

inline constexpr int kLargestPixel = 65536;

// Reads the keys of one table of a wall file; throws Fault.
class TableReader {
 public:
  TableReader(const toml::table& table, std::string section) : table_(table), section_(std::move(section)) {}

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_) {
      if (std::find(keys.begin(), keys.end(), key.str()) == keys.end()) {
        throw Fault{node.source(), name(key.str()), fmt::format("unknown key; known are {}", fmt::join(keys, ", "))};
      }
    }
  }

  std::string text(std::string_view key) const {
    const auto value = required(key).value_exact<std::string>();
    if (!value || value->empty()) throw Fault{required(key).source(), name(key), "must be text and not empty"};
    return *value;
  }

  template <std::size_t Count>
  std::array<double, Count> numbers(std::string_view key, const char* meaning) const {
    const toml::node& node = required(key);
    const toml::array* array = node.as_array();
    std::array<double, Count> values{};
    if (array == nullptr || array->size() != Count) {
      throw Fault{node.source(), name(key), fmt::format("must be {}", meaning)};
    }
    for (std::size_t i = 0; i < Count; ++i) {
      const auto value = (*array)[i].value<double>();
      if (!value || !std::isfinite(*value)) throw Fault{node.source(), name(key), fmt::format("must be {}", meaning)};
      values[i] = *value;
    }
    return values;
  }

  glm::dvec3 point(std::string_view key) const {
    const auto v = numbers<3>(key, "three numbers [x, y, z] in metres");
    return {v[0], v[1], v[2]};
  }

  double length_m(std::string_view key, double smallest, double largest) const {
    const auto parsed = physics::parse_quantity(text(key), physics::kLengthUnits);
    if (!parsed.value) throw Fault{required(key).source(), name(key), parsed.error};
    const double value = parsed.value->si;
    if (value < smallest || value > largest) {
      throw Fault{required(key).source(), name(key),
                  fmt::format("is {:g} mm; it must lie between {:g} mm and {:g} mm", value * 1e3, smallest * 1e3,
                              largest * 1e3)};
    }
    return value;
  }

  std::optional<double> number(std::string_view key, double smallest, double largest, const char* meaning) const {
    if (!has(key)) return std::nullopt;
    const auto value = required(key).value<double>();
    if (!value || !(*value >= smallest && *value <= largest)) {
      fail(key, fmt::format("must be a number from {:g} to {:g}, {}", smallest, largest, meaning));
    }
    return value;
  }

  bool has(std::string_view key) const { return table_.contains(key); }

  bool flag(std::string_view key) const {
    const auto value = required(key).value_exact<bool>();
    if (!value) throw Fault{required(key).source(), name(key), "must be true or false"};
    return *value;
  }

  // Pixels: [x, y, width, height].
  PixelRect rect(std::string_view key) const {
    const auto v = numbers<4>(key, "four whole numbers [x, y, width, height] in pixels");
    for (const double value : v) {
      if (value != std::floor(value) || std::abs(value) > kLargestPixel) {
        fail(key, fmt::format("must be four whole numbers [x, y, width, height] in pixels, up to {}", kLargestPixel));
      }
    }
    if (v[2] < 1 || v[3] < 1) fail(key, fmt::format("is {:g} x {:g} pixels; it must be at least 1 x 1", v[2], v[3]));
    return {glm::ivec2(v[0], v[1]), glm::uvec2(v[2], v[3])};
  }

  [[noreturn]] void fail(std::string_view key, std::string what) const {
    throw Fault{has(key) ? table_.get(key)->source() : table_.source(), name(key), std::move(what)};
  }

 private:
  std::string name(std::string_view key) const { return section_ + "." + std::string(key); }

  const toml::node& required(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) throw Fault{table_.source(), name(key), "is missing"};
    return *node;
  }

  const toml::table& table_;
  std::string section_;
};

}  // namespace afm::scene
