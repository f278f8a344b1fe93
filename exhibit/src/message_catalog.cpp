// SPDX-License-Identifier: Apache-2.0
#include "exhibit/message_catalog.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "scene/config/toml_file.h"

namespace afm::exhibit {

namespace {

// Of UTF-8, which the TOML parser has checked: all bytes but those that go on with a character.
std::size_t characters(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

void check_places(const toml::node& node, std::string_view key, std::string_view text,
                  std::span<const std::string_view> places) {
  for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
    const std::string_view rest = text.substr(at);
    if (std::none_of(places.begin(), places.end(), [&](std::string_view place) { return rest.starts_with(place); })) {
      throw scene::Fault{
          node.source(), std::string(key),
          fmt::format("{} is unknown; known are {}", rest.substr(0, rest.find('}') + 1), fmt::join(places, ", "))};
    }
  }
}

std::string phrase_of(const toml::table& table, std::string_view key, std::span<const std::string_view> places) {
  const toml::node* node = table.get(key);
  if (node == nullptr) throw scene::Fault{table.source(), std::string(key), "is missing"};
  const auto text = node->value_exact<std::string>();
  const bool one_line = text && std::none_of(text->begin(), text->end(), [](char c) { return c >= 0 && c < ' '; });
  if (!one_line || text->empty() || characters(*text) > kLongestPhrase) {
    throw scene::Fault{node->source(), std::string(key),
                       fmt::format("must be one line of 1 to {} characters in quotes", kLongestPhrase)};
  }
  check_places(*node, key, *text, places);
  return *text;
}

bool contains(std::span<const std::string_view> keys, std::string_view key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

}  // namespace

core::Result<std::vector<std::string>> load_messages(const std::string& path, const MessageKeys& keys) {
  return scene::read_toml("phrase file", path, [&](const toml::table& root) {
    for (const auto& [key, node] : root) {
      if (!contains(keys.keys, key.str()) && !contains(keys.optional_keys, key.str())) {
        throw scene::Fault{node.source(), std::string(key.str()),
                           fmt::format("unknown key; known are {}, {}", fmt::join(keys.keys, ", "),
                                       fmt::join(keys.optional_keys, ", "))};
      }
    }
    std::vector<std::string> phrases;
    for (const std::string_view key : keys.keys) phrases.push_back(phrase_of(root, key, keys.places));
    for (const std::string_view key : keys.optional_keys) {
      phrases.push_back(root.contains(key) ? phrase_of(root, key, keys.places) : std::string());
    }
    return phrases;
  });
}

}  // namespace afm::exhibit
