// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "exhibit/words/phrases.h"
#include "support/places.h"

namespace afm::test {

inline const std::string kPhraseFolder = support::source("assets/guidance/");

inline const exhibit::Phrases& english() {
  static const exhibit::Phrases phrases = exhibit::Phrases::load(kPhraseFolder + "en.toml").value();
  return phrases;
}

// Text with an accent on each vowel and each third letter twice, which makes it a third longer. Text in braces does not
// change.
inline std::string pseudo_text(std::string_view english) {
  static constexpr std::array<std::pair<char, const char*>, 12> kAccents{{{'a', "á"},
                                                                          {'e', "ê"},
                                                                          {'i', "ï"},
                                                                          {'o', "ö"},
                                                                          {'u', "ü"},
                                                                          {'y', "ÿ"},
                                                                          {'A', "Å"},
                                                                          {'E', "É"},
                                                                          {'I', "Ï"},
                                                                          {'O', "Ø"},
                                                                          {'U', "Ü"},
                                                                          {'Y', "Ý"}}};
  std::string text;
  std::size_t letters = 0;
  for (std::size_t i = 0; i < english.size(); ++i) {
    if (english[i] == '{') {
      const std::size_t end = english.find('}', i);
      text += english.substr(i, end + 1 - i);
      i = end;
      continue;
    }
    std::string letter(1, english[i]);
    for (const auto& [plain, accented] : kAccents) {
      if (english[i] == plain) letter = accented;
    }
    const bool is_letter = letter.size() > 1 || (letter[0] >= 'a' && letter[0] <= 'z');
    text += is_letter && ++letters % 3 == 0 ? letter + letter : letter;
  }
  return text;
}

// English as a longer, accented language, so that cut or untranslated texts are visible. Its words are those that
// German translates.
inline std::string pseudo_language() {
  std::string file;
  for (const char* name : {"en.toml", "de.toml"}) {
    std::ifstream lines(kPhraseFolder + name);
    bool words = false;
    for (std::string line; std::getline(lines, line);) {
      if (line == "[words]") {
        words = true;
        file += line + "\n";
      }
      const std::size_t equals = line.find(" = \"");
      if (equals == std::string::npos || line.starts_with('#') || words != (std::string_view(name) == "de.toml"))
        continue;
      const std::string key = line.substr(0, equals);
      const std::size_t begin = equals + 4;
      const std::string text = words ? key.substr(1, key.size() - 2) : line.substr(begin, line.rfind('"') - begin);
      const bool technical = key == "language" || key == "decimal-mark";
      file +=
          key + " = \"" + (technical ? line.substr(begin, line.find('"', begin) - begin) : pseudo_text(text)) + "\"\n";
    }
  }
  return file;
}

}  // namespace afm::test
