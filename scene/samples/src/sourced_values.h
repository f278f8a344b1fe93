// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"
#include "scene/config/toml_table.h"
#include "scene/samples/sourced_value.h"

namespace afm::scene {

// The numbers of one [[material]] or [[probe]], written { value = "50 nm", source = "citation", estimated = true }.
// Remembers the source of every number that was read. Throws Faults that name the key; never leaves scene/samples/src.
class SourcedValues {
 public:
  // The table must outlive it.
  explicit SourcedValues(const TomlTable& table) : table_(table) {}

  template <class Q>
  Q quantity(std::string_view key, const physics::UnitList<Q>& units,
             physics::Infinity infinity = physics::Infinity::Refused) {
    const auto parsed = pair_of(key).parsed_quantity("value", units, infinity);
    if (!parsed.value) table_.refuse(key, parsed.error);
    remember_source(key, pair_of(key).text("value"));
    return *parsed.value;
  }

  template <class Q>
  std::optional<Q> optional_quantity(std::string_view key, const physics::UnitList<Q>& units) {
    if (!table_.has(key)) return std::nullopt;
    return quantity(key, units);
  }

  // A number without dimension: { value = 0.25, ... }.
  double number(std::string_view key);

  void add_source(SourcedValue source) { sources_.push_back(std::move(source)); }
  std::vector<SourcedValue> take_sources() { return std::exchange(sources_, {}); }

 private:
  TomlTable pair_of(std::string_view key) const;
  void remember_source(std::string_view key, std::string written);

  const TomlTable& table_;
  std::vector<SourcedValue> sources_;
};

// Message of a value that physics refuses, with the key of the file instead of the field at its beginning:
// "particle modulus -1 Pa is not ...".
std::string message_of(const physics::UnphysicalValue& error, std::string_view key);

}  // namespace afm::scene
