// SPDX-License-Identifier: Apache-2.0
#include "sourced_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace afm::scene {

const SourcedValue* find_source(std::span<const SourcedValue> sources, std::string_view key) {
  const auto at = std::find_if(sources.begin(), sources.end(), [&](const SourcedValue& s) { return s.key == key; });
  return at == sources.end() ? nullptr : &*at;
}

TomlTable SourcedValues::pair_of(std::string_view key) const {
  TomlTable pair = table_.table(key, "{ value = \"number unit\", source = \"citation\" }");
  pair.allow_only({"value", "source", "estimated"});
  return pair;
}

void SourcedValues::remember_source(std::string_view key, std::string written) {
  const TomlTable pair = pair_of(key);
  const bool estimated = pair.has("estimated") && pair.flag("estimated");
  sources_.push_back({std::string(key), std::move(written), pair.text("source"), estimated});
}

double SourcedValues::number(std::string_view key) {
  const TomlTable pair = pair_of(key);
  const toml::node* const written = pair.has("value") ? &pair.node("value") : nullptr;
  const auto value = written == nullptr ? std::nullopt : written->value<double>();
  if (!value || !std::isfinite(*value) || !written->is_number()) {
    table_.refuse(key, "its value must be a number without a unit");
  }
  remember_source(key, fmt::format("{}", *value));
  return *value;
}

std::string message_of(const physics::UnphysicalValue& error, std::string_view key) {
  const auto in_words = [](std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
  };
  std::string message = error.what();
  const std::string field = in_words(error.field());
  if (message.starts_with(field + " ")) message.replace(0, field.size(), in_words(key));
  return message;
}

}  // namespace afm::scene
