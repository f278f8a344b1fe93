// SPDX-License-Identifier: Apache-2.0
#include "sourced_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/config/toml_file.h"

namespace afm::scene {

const SourcedValue* find_source(std::span<const SourcedValue> sources, std::string_view key) {
  const auto at = std::find_if(sources.begin(), sources.end(), [&](const SourcedValue& s) { return s.key == key; });
  return at == sources.end() ? nullptr : &*at;
}

void SourcedTable::refuse_keys_other_than(std::span<const std::string_view> known) const {
  for (const auto& [key, node] : table_) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    throw Fault{node.source(), name(key.str()), fmt::format("unknown key; known are {}", fmt::join(known, ", "))};
  }
}

void SourcedTable::refuse(std::string_view key, const std::string& why) const {
  throw Fault{has(key) ? table_.get(key)->source() : table_.source(), name(key), why};
}

const toml::node& SourcedTable::node_of(std::string_view key) const {
  const toml::node* node = table_.get(key);
  if (node == nullptr) refuse(key, "is missing");
  return *node;
}

const toml::table& SourcedTable::pair_of(std::string_view key) const {
  const toml::table* pair = node_of(key).as_table();
  if (pair == nullptr) refuse(key, "must be written { value = \"number unit\", source = \"citation\" }");
  for (const auto& [inner, node] : *pair) {
    if (inner.str() == "value" || inner.str() == "source" || inner.str() == "estimated") continue;
    throw Fault{node.source(), name(key) + "." + std::string(inner.str()),
                "unknown key; known are value, source, estimated"};
  }
  return *pair;
}

std::string SourcedTable::text_in(const toml::table& table, std::string_view key, const std::string& outer) const {
  const toml::node* node = table.get(key);
  if (node == nullptr) throw Fault{table.source(), name(outer + std::string(key)), "is missing"};
  const auto value = node->value_exact<std::string>();
  if (!value || value->empty()) {
    throw Fault{node->source(), name(outer + std::string(key)), "must be text and not empty"};
  }
  return *value;
}

std::string SourcedTable::text(std::string_view key) const { return text_in(table_, key, ""); }

void SourcedTable::remember_source(std::string_view key, std::string written) {
  const toml::table& pair = pair_of(key);
  bool estimated = false;
  if (const toml::node* flag = pair.get("estimated")) {
    const auto value = flag->value_exact<bool>();
    if (!value) throw Fault{flag->source(), name(key) + ".estimated", "must be true or false"};
    estimated = *value;
  }
  sources_.push_back(
      {std::string(key), std::move(written), text_in(pair, "source", std::string(key) + "."), estimated});
}

std::string SourcedTable::remember(std::string_view key) {
  std::string written = text_in(pair_of(key), "value", std::string(key) + ".");
  remember_source(key, written);
  return written;
}

double SourcedTable::number(std::string_view key) {
  const toml::node* node = pair_of(key).get("value");
  const auto value = node == nullptr ? std::nullopt : node->value<double>();
  if (!value || !std::isfinite(*value) || !node->is_number()) refuse(key, "its value must be a number without a unit");
  remember_source(key, fmt::format("{}", *value));
  return *value;
}

std::vector<const toml::table*> tables_of(const toml::table& root, const std::string& kind) {
  for (const auto& [key, node] : root) {
    if (key.str() != kind) throw Fault{node.source(), std::string(key.str()), "unknown key; known is " + kind};
  }
  const toml::node* node = root.get(kind);
  if (node == nullptr) throw Fault{root.source(), kind, "is missing; the file needs at least one [[" + kind + "]]"};
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty()) throw Fault{node->source(), kind, "must be written [[" + kind + "]]"};

  constexpr std::size_t kLargestFile = 1000;
  if (array->size() > kLargestFile) {
    throw Fault{node->source(), kind, fmt::format("the file has more than {} of them", kLargestFile)};
  }
  std::vector<const toml::table*> tables;
  for (const toml::node& element : *array) {
    tables.push_back(element.as_table());
    if (tables.back() == nullptr) throw Fault{element.source(), kind, "must be written [[" + kind + "]]"};
  }
  return tables;
}

}  // namespace afm::scene
