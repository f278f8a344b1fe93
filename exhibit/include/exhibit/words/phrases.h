// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/result.h"
#include "exhibit/words/lesson_phrase_list.h"
#include "exhibit/words/particle_phrase_list.h"
#include "exhibit/words/phrase_list.h"
#include "exhibit/words/sound_phrase_list.h"

namespace afm::exhibit {

// Largest number of characters of a text: one line on the wall, one paragraph in the report.
inline constexpr std::size_t kLine = 100, kParagraph = 700;

// Placeholders of a guidance line: the controls of the haptic device.
inline constexpr std::string_view kControlPlaces = "up? down? turn-on? choose?";

// Placeholders of an event's caption and speech: its force, and the material under the tip.
inline constexpr std::string_view kEventPlaces = "force? sample?";

#define AFM_PHRASE_NAME(name, key, places, limit) name,
enum class Phrase : std::size_t { AFM_FOR_EACH_PHRASE(AFM_PHRASE_NAME) };
#undef AFM_PHRASE_NAME

struct PhraseRow {
  std::string_view key;     // key in the phrase files
  std::string_view places;  // names of the placeholders without braces: "tip medium"
  std::size_t limit;        // largest number of characters
};

#define AFM_PHRASE_ROW(name, key, places, limit) PhraseRow{key, places, limit},
inline constexpr auto kPhraseRows = std::to_array<PhraseRow>({AFM_FOR_EACH_PHRASE(AFM_PHRASE_ROW)});
#undef AFM_PHRASE_ROW

constexpr const PhraseRow& row_of(Phrase phrase) { return kPhraseRows[static_cast<std::size_t>(phrase)]; }

constexpr std::size_t place_count(Phrase phrase) {
  std::size_t count = row_of(phrase).places.empty() ? 0 : 1;
  for (const char c : row_of(phrase).places) count += c == ' ' ? 1 : 0;
  return count;
}

// Phrase `steps` rows below `first`, in a run of rows with the order of an enumeration.
constexpr Phrase after(Phrase first, std::size_t steps) {
  return static_cast<Phrase>(static_cast<std::size_t>(first) + steps);
}

// All texts of wall and report in one language, from a TOML file of `key = "text"` (assets/guidance). Its table [words]
// translates words with other origins: names of materials, media, sources, keys and devices. Const after loading; any
// thread.
class Phrases {
 public:
  // Requires every phrase. The error names file, line and key.
  static core::Result<Phrases> load(const std::string& path);

  // Same for a user's file; phrases that it lacks come from `base`.
  static core::Result<Phrases> load(const std::string& path, const Phrases& base);

  // Text as in the file, for phrases without placeholders.
  const std::string& operator[](Phrase phrase) const { return texts_[static_cast<std::size_t>(phrase)]; }

  // Text with its placeholders filled, in the order of its row. Numbers get the language's decimal mark.
  template <Phrase phrase, class... Texts>
  std::string text(const Texts&... texts) const {
    static_assert(sizeof...(Texts) == place_count(phrase), "a text for each placeholder of the phrase");
    const std::array<std::string, sizeof...(Texts)> values{number(std::string(texts))...};
    return filled(phrase, values);
  }

  // Same for a phrase chosen at run time. Values are not changed.
  std::string filled(Phrase phrase, std::span<const std::string> values) const;

  // Translation of a word, or of the word before a number ("Gold 0.1 N/m"); otherwise the word itself.
  std::string word(const std::string& english) const;

  // The text with this language's decimal mark in its numbers, but not in versions and addresses.
  std::string number(std::string text) const;
  char decimal_mark() const;

 private:
  std::array<std::string, kPhraseRows.size()> texts_;
  std::map<std::string, std::string, std::less<>> words_;
};

}  // namespace afm::exhibit
