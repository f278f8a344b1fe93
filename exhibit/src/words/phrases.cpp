// SPDX-License-Identifier: Apache-2.0
#include "exhibit/words/phrases.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "core/printable.h"
#include "scene/config/toml_file.h"

namespace afm::exhibit {

namespace {

constexpr const char* kWords = "words";

struct Place {
  std::string braced;  // "{up}"
  bool needed = true;
};

std::vector<Place> places_of(const PhraseRow& row) {
  std::vector<Place> places;
  for (std::string_view rest = row.places; !rest.empty();) {
    std::string_view name = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(name.size() + 1, rest.size()));
    const bool needed = !name.ends_with('?');
    if (!needed) name.remove_suffix(1);
    places.push_back({fmt::format("{{{}}}", name), needed});
  }
  return places;
}

std::string list_of(const std::vector<Place>& places) {
  std::string list;
  for (const Place& place : places) list += (list.empty() ? "" : ", ") + place.braced;
  return list.empty() ? "none" : list;
}

[[noreturn]] void refuse(const toml::node& node, std::string_view key, std::string what) {
  throw scene::Fault{node.source(), std::string(key), std::move(what)};
}

std::string line_of(const toml::node& node, std::string_view key, std::size_t limit) {
  const auto text = node.value_exact<std::string>();
  if (!text || text->empty() || core::count_characters(*text) > limit) {
    refuse(node, key, fmt::format("must be text of 1 to {} characters in quotes", limit));
  }
  return *text;
}

void check_places(const toml::node& node, const PhraseRow& row, std::string_view text) {
  const std::vector<Place> places = places_of(row);
  for (std::size_t at = text.find('{'); at != std::string_view::npos; at = text.find('{', at + 1)) {
    const std::string_view rest = text.substr(at);
    if (std::none_of(places.begin(), places.end(),
                     [&](const Place& place) { return rest.starts_with(place.braced); })) {
      refuse(node, row.key,
             fmt::format("{} is unknown; known are {}", rest.substr(0, rest.find('}') + 1), list_of(places)));
    }
  }
  for (const Place& place : places) {
    if (place.needed && text.find(place.braced) == std::string_view::npos) {
      refuse(node, row.key, fmt::format("lacks {}; its text must hold {}", place.braced, list_of(places)));
    }
  }
}

void put(std::string_view place, std::string_view value, std::string& text) {
  for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + value.size())) {
    text.replace(at, place.size(), value);
  }
}

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// End of the word before a number: "Gold 0.1 N/m".
std::optional<std::size_t> end_of_word_before_number(std::string_view text) {
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    if (text[i] == ' ' && is_digit(text[i + 1])) return i;
  }
  return std::nullopt;
}

}  // namespace

core::Result<Phrases> Phrases::load(const std::string& path) {
  auto phrases = load(path, Phrases{});
  if (!phrases) return phrases;
  for (std::size_t i = 0; i < kPhraseRows.size(); ++i) {
    if (!phrases->texts_[i].empty()) continue;
    return tl::unexpected(
        scene::toml_error("phrase file", path, {{{1, 1}, {1, 1}, {}}, std::string(kPhraseRows[i].key), "is missing"}));
  }
  return phrases;
}

core::Result<Phrases> Phrases::load(const std::string& path, const Phrases& base) {
  return scene::read_toml("phrase file", path, [&](const toml::table& root) {
    Phrases phrases = base;
    for (const auto& [key, node] : root) {
      if (key.str() == kWords && node.is_table()) {
        for (const auto& [word, text] : *node.as_table()) {
          phrases.words_.insert_or_assign(std::string(word.str()), line_of(text, word.str(), kParagraph));
        }
        continue;
      }
      const auto* const row = std::find_if(kPhraseRows.begin(), kPhraseRows.end(),
                                           [&](const PhraseRow& each) { return each.key == key.str(); });
      if (row == kPhraseRows.end()) refuse(node, key.str(), "unknown key; assets/guidance/en.toml has all keys");
      std::string text = line_of(node, row->key, row->limit);
      check_places(node, *row, text);
      phrases.texts_[static_cast<std::size_t>(row - kPhraseRows.begin())] = std::move(text);
    }
    return phrases;
  });
}

std::string Phrases::filled(Phrase phrase, std::span<const std::string> values) const {
  std::string text = (*this)[phrase];
  const std::vector<Place> places = places_of(row_of(phrase));
  for (std::size_t i = 0; i < std::min(places.size(), values.size()); ++i) put(places[i].braced, values[i], text);
  return text;
}

std::string Phrases::word(const std::string& english) const {
  if (const auto found = words_.find(english); found != words_.end()) return found->second;
  const auto end = end_of_word_before_number(english);
  if (!end) return english;
  const auto found = words_.find(std::string_view(english).substr(0, *end));
  return found == words_.end() ? english : found->second + number(english.substr(*end));
}

char Phrases::decimal_mark() const {
  const std::string& mark = (*this)[Phrase::DecimalMark];
  return mark.empty() ? '.' : mark.front();
}

std::string Phrases::number(std::string text) const {
  const char mark = decimal_mark();
  const auto digit_at = [&](std::size_t i) { return i < text.size() && is_digit(text[i]); };
  for (std::size_t begin = 0; mark != '.' && begin < text.size();) {
    // digits and points are a number if there is a single point between digits
    std::size_t end = begin;
    while (digit_at(end) || (end > begin && end < text.size() && text[end] == '.' && digit_at(end + 1))) ++end;
    const auto run = std::string_view(text).substr(begin, end - begin);
    const std::size_t point = run.find('.');
    if (point != std::string_view::npos && point == run.rfind('.')) text[begin + point] = mark;
    begin = std::max(end, begin + 1);
  }
  return text;
}

}  // namespace afm::exhibit
