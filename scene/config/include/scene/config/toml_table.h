// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "physics/quantity_text.h"

namespace afm::scene {

// One table of a TOML file. Each reader throws a Fault that gives the key, its line, and what was expected there. A key
// that is read must exist; has() returns whether it does. The table must outlive it.
class TomlTable {
 public:
  static constexpr std::size_t kMostTables = 1000;

  // `name` precedes each key in faults: "screen" in screen.name. Empty: the root of a file.
  explicit TomlTable(const toml::table& table, std::string name = {}) : table_(&table), name_(std::move(name)) {}

  bool has(std::string_view key) const { return table_->contains(key); }

  // `what` names the keys in the refusal: "unknown key; known are ...".
  void allow_only(std::span<const std::string_view> keys, std::string_view what = "key") const;
  void allow_only(std::initializer_list<std::string_view> keys) const {
    allow_only(std::span(keys.begin(), keys.size()));
  }

  // Throws a Fault at the key, or at the table that lacks it.
  [[noreturn]] void refuse(std::string_view key, std::string what) const;

  const toml::node& node(std::string_view key) const;

  std::string text(std::string_view key) const;  // value of the key, at least one character
  std::string text(std::string_view key, std::size_t most_bytes) const;
  std::vector<std::string> texts(std::string_view key, std::size_t most) const;  // one to `most` distinct values
  bool flag(std::string_view key) const;
  std::int64_t whole(std::string_view key, std::int64_t least, std::int64_t most) const;

  // `meaning` ends the refusal: "must be a number from 1 to 4, MEANING".
  double number(std::string_view key, double least, double most, std::string_view meaning = {}) const;

  // An array of finite numbers, such as `meaning`: "four numbers [x, y, width, height]".
  template <std::size_t Count>
  std::array<double, Count> numbers(std::string_view key, std::string_view meaning) const {
    const toml::array* const array = node(key).as_array();
    std::array<double, Count> values{};
    if (array == nullptr || array->size() != Count) refuse(key, fmt::format("must be {}", meaning));
    for (std::size_t i = 0; i < Count; ++i) {
      const auto value = (*array)[i].value<double>();
      if (!value || !std::isfinite(*value)) refuse(key, fmt::format("must be {}", meaning));
      values[i] = *value;
    }
    return values;
  }
  glm::dvec3 point(std::string_view key) const;     // three coordinates in metres
  glm::dquat rotation(std::string_view key) const;  // quaternion [x, y, z, w]

  // A text of number and unit: "50 nm".
  template <class Q>
  Q quantity(std::string_view key, const physics::UnitList<Q>& units,
             physics::Infinity infinity = physics::Infinity::Refused) const {
    const auto parsed = parsed_quantity(key, units, infinity);
    if (!parsed.value) refuse(key, parsed.error);
    return *parsed.value;
  }
  // Same as quantity(), but returns the error. The error for a number outside quotes names the units, too.
  template <class Q>
  physics::ParsedQuantity<Q> parsed_quantity(std::string_view key, const physics::UnitList<Q>& units,
                                             physics::Infinity infinity) const {
    const std::optional<std::string> bare = bare_number(key);
    auto parsed = physics::parse_quantity(bare ? *bare : text(key), units, infinity);
    if (bare) parsed = {std::nullopt, (parsed.value ? "write the number" : parsed.error) + ", in quotes"};
    return parsed;
  }

  // The row whose word is the text.
  template <class Rows, class Row>
  const Row& one_of(std::string_view key, const Rows& rows, std::string_view Row::* word) const {
    return row_named(key, text(key), rows, word);
  }
  // Same as one_of(), with a text that has already been read from the key.
  template <class Rows, class Row>
  const Row& row_named(std::string_view key, std::string_view value, const Rows& rows,
                       std::string_view Row::* word) const {
    std::string known;
    for (const Row& row : rows) {
      if (row.*word == value) return row;
      known += (known.empty() ? "" : ", ") + std::string(row.*word);
    }
    refuse(key, fmt::format("{} is unknown; known are {}", value, known));
  }

  // The table of a key that must be written like `how`: "[device]".
  TomlTable table(std::string_view key, std::string_view how) const;

  // The tables [[key]], at least one.
  std::vector<TomlTable> tables(std::string_view key, std::size_t most = kMostTables) const;

 private:
  std::string full(std::string_view key) const;
  std::optional<std::string> bare_number(std::string_view key) const;  // number outside quotes, as written

  const toml::table* table_;
  std::string name_;
};

}  // namespace afm::scene
