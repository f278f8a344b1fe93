// SPDX-License-Identifier: Apache-2.0
#include "output/window_keys.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "output/window_system.h"

namespace afm::render {
namespace window_keys_test {

// Labels of the keys at the places of a US keyboard, row by row, without Shift; a space: a dead key.
struct Keyboard {
  const char32_t* rows[4];
};

constexpr const char* kPlaces[4] = {"`1234567890-=", "QWERTYUIOP[]\\", "ASDFGHJKL;'", "ZXCVBNM,./"};

const std::map<std::string, Keyboard> kKeyboards{
    {"us", {{U"`1234567890-=", U"qwertyuiop[]\\", U"asdfghjkl;'", U"zxcvbnm,./"}}},
    {"de", {{U" 1234567890ß ", U"qwertzuiopü+#", U"asdfghjklöä", U"yxcvbnm,.-"}}},
    {"fr", {{U"²&é\"'(-è_çà)=", U"azertyuiop $*", U"qsdfghjklmù", U"wxcvbn,;:!"}}},
    {"tr", {{U"\"1234567890*-", U"qwertyu\u0131op\u011f\u00fc,", U"asdfghjkl\u015fi", U"zxcvbnm\u00f6\u00e7."}}},
    {"gr", {{U"`1234567890-=", U";ςερτυθιοπ[]\\", U"ασδφγηξκλ '", U"ζχψωβνμ,./"}}},
    {"ru", {{U"ё1234567890-=", U"йцукенгшщзхъ\\", U"фывапролджэ", U"ячсмитьбю."}}},
};

std::string utf8(char32_t sign) {
  if (sign < 0x80) return {static_cast<char>(sign)};
  return {static_cast<char>(0xC0U | sign >> 6U), static_cast<char>(0x80U | (sign & 0x3FU))};
}

LabelOfKey labels_of(const std::string& layout) {
  std::map<int, std::string> labels;
  for (int row = 0; row < 4; ++row) {
    for (int i = 0; kPlaces[row][i] != '\0'; ++i) {
      const char32_t label = kKeyboards.at(layout).rows[row][i];
      if (label != U' ') labels[kPlaces[row][i]] = utf8(label);
    }
  }
  return [labels](int code) {
    const auto label = labels.find(code);
    return label == labels.end() ? std::string() : label->second;
  };
}

// The key at a place of a US keyboard, and what it types.
Key pressed(const std::string& layout, char place, char32_t typed) { return key_of(place, typed, labels_of(layout)); }

TEST(KeysOfALayout, AreItsLabels) {
  EXPECT_EQ(pressed("us", 'Y', U'y'), Key::Y);
  EXPECT_EQ(pressed("de", 'Y', U'z'), Key::Z);
  EXPECT_EQ(pressed("de", 'Z', U'y'), Key::Y);
  EXPECT_EQ(pressed("fr", 'Q', U'a'), Key::A);
  EXPECT_EQ(pressed("fr", 'A', U'q'), Key::Q);
  EXPECT_EQ(pressed("fr", ';', U'm'), Key::M);
  EXPECT_EQ(pressed("fr", 'M', U','), Key::Other) << "M is elsewhere";
  EXPECT_EQ(pressed("fr", 'M', U'?'), Key::Other);
  EXPECT_EQ(pressed("tr", 'I', U'\u0131'), Key::I) << "the dotless letter, labelled I";
  EXPECT_EQ(pressed("tr", 'I', 0), Key::I);
  EXPECT_EQ(pressed("tr", '\'', U'i'), Key::I);
  EXPECT_EQ(pressed("tr", '\'', U'\u0130'), Key::I);
}

TEST(KeysOfALayout, ArePlusAndMinusWhereverTheyAreTyped) {
  EXPECT_EQ(pressed("us", '=', U'='), Key::Plus) << "+ is the second sign of this key";
  EXPECT_EQ(pressed("us", '=', U'+'), Key::Plus);
  EXPECT_EQ(pressed("us", '-', U'-'), Key::Minus);
  EXPECT_EQ(pressed("de", ']', U'+'), Key::Plus);
  EXPECT_EQ(pressed("de", '/', U'-'), Key::Minus);
  EXPECT_EQ(pressed("de", '=', 0), Key::Other) << "a dead accent";
  EXPECT_EQ(pressed("de", '-', U'ß'), Key::Other);
  EXPECT_EQ(pressed("de", '0', U'='), Key::Digit0) << "Shift and 0";
  EXPECT_EQ(pressed("fr", '6', U'-'), Key::Minus);
  EXPECT_EQ(pressed("fr", '=', U'+'), Key::Plus);
}

TEST(KeysOfALayout, AreTheDigitsOfTheNumberRowWithAndWithoutShift) {
  for (const auto& [layout, keyboard] : kKeyboards) {
    for (int i = 0; i <= 9; ++i) {
      const auto digit = static_cast<Key>(static_cast<int>(Key::Digit0) + i);
      const char32_t label = keyboard.rows[0][i == 0 ? 10 : i];
      if (label != U'-') {
        EXPECT_EQ(pressed(layout, static_cast<char>('0' + i), label), digit) << layout << i;
      }
      EXPECT_EQ(pressed(layout, static_cast<char>('0' + i), U'0' + static_cast<char32_t>(i)), digit) << layout << i;
    }
  }
}

TEST(KeysOfALayout, AreTheirPlacesWhereItLacksLetters) {
  for (const char* const layout : {"gr", "ru"}) {
    const LabelOfKey labels = labels_of(layout);
    for (char place = 'A'; place <= 'Z'; ++place) {
      const auto letter = static_cast<Key>(static_cast<int>(Key::A) + place - 'A');
      EXPECT_EQ(key_of(place, 0, labels), letter) << layout << place;
      EXPECT_EQ(key_of(place, U'Я', labels), letter) << layout << place;
    }
  }
  EXPECT_EQ(pressed("gr", 'Q', U';'), Key::Q);
  EXPECT_EQ(key_of(-1, U't', labels_of("ru")), Key::T) << "an unknown key that types a letter";
}

TEST(KeysOfALayout, HaveNoOtherSigns) {
  for (const auto& [layout, keyboard] : kKeyboards) {
    for (const char place : {'[', ']', '\\', '\'', '`', '.'}) {
      const std::string printed = labels_of(layout)(place);
      const char32_t label = static_cast<unsigned char>(printed.size() == 1 ? printed.front() : '\0');
      const bool is_letter = label >= U'a' && label <= U'z';  // the letter i of a Turkish layout
      if (is_letter || label == U'+' || label == U'-') continue;
      EXPECT_EQ(pressed(layout, place, label), Key::Other) << layout << place;
    }
  }
}

TEST(KeysOfALayout, AreThoseOfTheNumpadToo) {
  const LabelOfKey none = [](int) { return std::string(); };
  EXPECT_EQ(key_of(GLFW_KEY_KP_ENTER, 0, none), Key::Enter);
  EXPECT_EQ(key_of(GLFW_KEY_ENTER, 0, none), Key::Enter);
  EXPECT_EQ(key_of(GLFW_KEY_KP_0, U'0', none), Key::Digit0);
  EXPECT_EQ(key_of(GLFW_KEY_KP_9, 0, none), Key::Digit9);
  EXPECT_EQ(key_of(GLFW_KEY_KP_ADD, U'+', none), Key::Plus);
  EXPECT_EQ(key_of(GLFW_KEY_KP_SUBTRACT, U'-', none), Key::Minus);
  EXPECT_EQ(key_of(GLFW_KEY_F8, 0, none), Key::F8);
  EXPECT_EQ(key_of(GLFW_KEY_SPACE, U' ', none), Key::Space);
  EXPECT_EQ(key_of(GLFW_KEY_KP_MULTIPLY, U'*', none), Key::Other);
}

TEST(LettersOfALayout, AreItsOwnLabelsWhereItLacksLetters) {
  for (const char* const layout : {"us", "de", "fr"}) EXPECT_EQ(letters_of(labels_of(layout)), "") << layout;
  EXPECT_EQ(letters_of(labels_of("gr")), "ΑΒΨΔΕΦΓΗΙΞΚΛΜΝΟΠ;ΡΣΤΘΩΣΧΥΖ");
  EXPECT_EQ(letters_of(labels_of("ru")), "ФИСВУАПРШОЛДЬТЩЗЙКЫЕГМЦЧНЯ");
}

}  // namespace window_keys_test
}  // namespace afm::render
