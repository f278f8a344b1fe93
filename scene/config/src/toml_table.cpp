// SPDX-License-Identifier: Apache-2.0
#include "scene/config/toml_table.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "scene/config/toml_file.h"

namespace afm::scene {

std::string TomlTable::full(std::string_view key) const {
  return name_.empty() ? std::string(key) : fmt::format("{}.{}", name_, key);
}

std::optional<std::string> TomlTable::bare_number(std::string_view key) const {
  const toml::node& found = node(key);
  return found.is_number() ? std::optional(fmt::format("{}", *found.value<double>())) : std::nullopt;
}

void TomlTable::allow_only(std::span<const std::string_view> keys, std::string_view what) const {
  for (const auto& [key, value] : *table_) {
    if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
    refuse(key.str(),
           fmt::format("unknown {}; known {} {}", what, keys.size() == 1 ? "is" : "are", fmt::join(keys, ", ")));
  }
}

void TomlTable::refuse(std::string_view key, std::string what) const {
  const toml::node* const at = table_->get(key);
  throw Fault{at != nullptr ? at->source() : table_->source(), full(key), std::move(what)};
}

const toml::node& TomlTable::node(std::string_view key) const {
  const toml::node* const found = table_->get(key);
  if (found == nullptr) refuse(key, "is missing");
  return *found;
}

std::string TomlTable::text(std::string_view key) const {
  const auto value = node(key).value_exact<std::string>();
  if (!value || value->empty()) refuse(key, "must be text and not empty, in quotes");
  return *value;
}

std::string TomlTable::text(std::string_view key, std::size_t most_bytes) const {
  const auto value = node(key).value_exact<std::string>();
  if (!value || value->empty() || value->size() > most_bytes) {
    refuse(key, fmt::format("must be text of 1 to {} bytes in quotes", most_bytes));
  }
  return *value;
}

std::vector<std::string> TomlTable::texts(std::string_view key, std::size_t most) const {
  const toml::array* const array = node(key).as_array();
  if (array == nullptr || array->empty() || array->size() > most) {
    refuse(key, fmt::format("must be a list of 1 to {} texts", most));
  }
  std::vector<std::string> texts;
  for (const toml::node& element : *array) {
    const auto value = element.value_exact<std::string>();
    if (!value || value->empty() || std::find(texts.begin(), texts.end(), *value) != texts.end()) {
      refuse(key, "must be a list of texts, each of them once");
    }
    texts.push_back(*value);
  }
  return texts;
}

bool TomlTable::flag(std::string_view key) const {
  const auto value = node(key).value_exact<bool>();
  if (!value) refuse(key, "must be true or false");
  return *value;
}

std::int64_t TomlTable::whole(std::string_view key, std::int64_t least, std::int64_t most) const {
  const auto value = node(key).value_exact<std::int64_t>();
  if (!value || *value < least || *value > most) {
    refuse(key, fmt::format("must be a whole number from {} to {}", least, most));
  }
  return *value;
}

double TomlTable::number(std::string_view key, double least, double most, std::string_view meaning) const {
  const auto value = node(key).value<double>();
  if (!value || !(*value >= least && *value <= most)) {
    refuse(key,
           fmt::format("must be a number from {:g} to {:g}{}{}", least, most, meaning.empty() ? "" : ", ", meaning));
  }
  return *value;
}

glm::dvec3 TomlTable::point(std::string_view key) const {
  const auto v = numbers<3>(key, "three numbers [x, y, z] in metres");
  return {v[0], v[1], v[2]};
}

glm::dquat TomlTable::rotation(std::string_view key) const {
  constexpr const char* kMeaning = "a unit quaternion [x, y, z, w]";
  constexpr double kTolerance = 1e-3;
  const auto v = numbers<4>(key, kMeaning);
  const glm::dquat q(v[3], v[0], v[1], v[2]);
  if (!(std::abs(glm::length(q) - 1.0) <= kTolerance)) refuse(key, fmt::format("must be {}", kMeaning));
  return glm::normalize(q);
}

TomlTable TomlTable::table(std::string_view key, std::string_view how) const {
  if (!has(key)) refuse(key, fmt::format("is missing; it is written {}", how));
  const toml::table* const inner = node(key).as_table();
  if (inner == nullptr) refuse(key, fmt::format("must be written {}", how));
  return TomlTable(*inner, full(key));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key, std::size_t most) const {
  if (!has(key)) refuse(key, fmt::format("is missing; the file needs at least one [[{}]]", key));
  const toml::array* const array = node(key).as_array();
  if (array == nullptr || array->empty()) refuse(key, fmt::format("must be written [[{}]]", key));
  if (array->size() > most) refuse(key, fmt::format("the file has more than {} of them", most));
  std::vector<TomlTable> tables;
  for (const toml::node& element : *array) {
    const toml::table* const inner = element.as_table();
    if (inner == nullptr) throw Fault{element.source(), full(key), fmt::format("must be written [[{}]]", key)};
    tables.emplace_back(*inner, std::string(key));
  }
  return tables;
}

}  // namespace afm::scene
