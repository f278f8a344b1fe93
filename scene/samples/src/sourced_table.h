// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "physics/quantity_text.h"
#include "scene/samples/sourced_value.h"

namespace afm::scene {

// One [[material]] or [[probe]]: texts, and numbers in the form { value = "50 nm", source = "citation", estimated =
// true }. Records the source of every number read. Throws Faults that name the key, which are caught within scene/src.
class SourcedTable {
 public:
  // `kind` is the table's name in the file: "material".
  SourcedTable(const toml::table& table, std::string kind) : table_(table), kind_(std::move(kind)) {}

  bool has(std::string_view key) const { return table_.contains(key); }
  void refuse_keys_other_than(std::span<const std::string_view> known) const;
  [[noreturn]] void refuse(std::string_view key, const std::string& why) const;

  std::string text(std::string_view key) const;
  std::string text_or_empty(std::string_view key) const { return has(key) ? text(key) : std::string(); }

  template <class Q>
  Q quantity(std::string_view key, const physics::UnitList<Q>& units,
             physics::Infinity infinity = physics::Infinity::Refused) {
    const std::string written = remember(key);
    const auto parsed = physics::parse_quantity(written, units, infinity);
    if (!parsed.value) refuse(key, parsed.error);
    return *parsed.value;
  }

  template <class Q>
  std::optional<Q> optional_quantity(std::string_view key, const physics::UnitList<Q>& units) {
    if (!has(key)) return std::nullopt;
    return quantity(key, units);
  }

  // A dimensionless number: { value = 0.25, ... }.
  double number(std::string_view key);

  void add_source(SourcedValue source) { sources_.push_back(std::move(source)); }
  std::vector<SourcedValue>& sources() { return sources_; }

 private:
  std::string name(std::string_view key) const { return kind_ + "." + std::string(key); }
  const toml::node& node_of(std::string_view key) const;
  const toml::table& pair_of(std::string_view key) const;
  std::string text_in(const toml::table& table, std::string_view key, const std::string& outer) const;
  void remember_source(std::string_view key, std::string written);
  std::string remember(std::string_view key);

  const toml::table& table_;
  std::string kind_;
  std::vector<SourcedValue> sources_;
};

// The tables of the array `kind`, which must be the file's only key and not empty.
std::vector<const toml::table*> tables_of(const toml::table& root, const std::string& kind);

}  // namespace afm::scene
