// SPDX-License-Identifier: Apache-2.0
#include "output/window_keys.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "output/window_system.h"

namespace afm::render {

namespace {

// Run of keys within which GLFW's codes and Key increase together.
struct KeyRun {
  int first_code, last_code;
  Key first, last;
};

constexpr int index(Key key) { return static_cast<int>(key); }

// Keys by their places on a US keyboard: the runs of the main part in the order of Key, then the numpad.
constexpr std::array kRuns{
    KeyRun{GLFW_KEY_SPACE, GLFW_KEY_SPACE, Key::Space, Key::Space},
    KeyRun{GLFW_KEY_MINUS, GLFW_KEY_MINUS, Key::Minus, Key::Minus},
    KeyRun{GLFW_KEY_EQUAL, GLFW_KEY_EQUAL, Key::Plus, Key::Plus},
    KeyRun{GLFW_KEY_0, GLFW_KEY_9, Key::Digit0, Key::Digit9},
    KeyRun{GLFW_KEY_A, GLFW_KEY_Z, Key::A, Key::Z},
    KeyRun{GLFW_KEY_ESCAPE, GLFW_KEY_END, Key::Escape, Key::End},
    KeyRun{GLFW_KEY_F1, GLFW_KEY_F12, Key::F1, Key::F12},
    KeyRun{GLFW_KEY_KP_0, GLFW_KEY_KP_9, Key::Digit0, Key::Digit9},
    KeyRun{GLFW_KEY_KP_SUBTRACT, GLFW_KEY_KP_SUBTRACT, Key::Minus, Key::Minus},
    KeyRun{GLFW_KEY_KP_ADD, GLFW_KEY_KP_ADD, Key::Plus, Key::Plus},
    KeyRun{GLFW_KEY_KP_ENTER, GLFW_KEY_KP_ENTER, Key::Enter, Key::Enter},
};

constexpr bool every_key_has_a_code() {
  int next = index(Key::Other) + 1;
  for (const KeyRun& run : kRuns) {
    if (index(run.last) - index(run.first) != run.last_code - run.first_code) return false;
    if (index(run.first) == next) next = index(run.last) + 1;
  }
  return next == index(Key::F12) + 1;
}
static_assert(every_key_has_a_code());

Key at_place(int code) {
  const auto run = std::find_if(kRuns.begin(), kRuns.end(), [code](const KeyRun& candidate) {
    return code >= candidate.first_code && code <= candidate.last_code;
  });
  if (run == kRuns.end()) return Key::Other;
  return static_cast<Key>(index(run->first) + code - run->first_code);
}

// True for the codes of keys whose printed sign depends on the layout.
constexpr bool is_printing(int code) { return code >= GLFW_KEY_APOSTROPHE && code <= GLFW_KEY_WORLD_2; }

// A letter that is I, too, and its label in UTF-8: a Turkish layout has two keys labelled I.
struct OtherI {
  char32_t sign;
  std::string_view label;
};
constexpr std::array kOtherIs{OtherI{U'\u0131', "\u0131"}, OtherI{U'\u0130', "\u0130"}};

// Key named by a sign.
Key named(char32_t sign) {
  const auto in_run = [sign](char32_t first, Key key) {
    return static_cast<Key>(index(key) + static_cast<int>(sign - first));
  };
  if (sign >= U'a' && sign <= U'z') return in_run(U'a', Key::A);
  if (sign >= U'A' && sign <= U'Z') return in_run(U'A', Key::A);
  if (sign >= U'0' && sign <= U'9') return in_run(U'0', Key::Digit0);
  for (const OtherI& i : kOtherIs) {
    if (sign == i.sign) return Key::I;
  }
  if (sign == U'+') return Key::Plus;
  return sign == U'-' ? Key::Minus : Key::Other;
}

// Same for a label: a key labelled = has + as its second sign.
Key labelled(std::string_view label) {
  for (const OtherI& i : kOtherIs) {
    if (label == i.label) return Key::I;
  }
  if (label.size() != 1) return Key::Other;
  return label == "=" ? Key::Plus : named(static_cast<unsigned char>(label.front()));
}

// Keys that the layout labels, by index.
std::array<bool, index(Key::F12) + 1> labelled_keys(const LabelOfKey& label_of) {
  std::array<bool, index(Key::F12) + 1> has{};
  for (int code = GLFW_KEY_APOSTROPHE; code <= GLFW_KEY_WORLD_2; ++code) {
    has[static_cast<std::size_t>(index(labelled(label_of(code))))] = true;
  }
  return has;
}

// Capital form of a Greek or Cyrillic letter, or a sign of ASCII; none for others, which the panels' fonts may lack.
std::optional<std::string> capital(std::string_view label) {
  if (label.size() == 1) return std::string(label);
  if (label.size() != 2) return std::nullopt;
  const auto byte = [label](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(label[i])); };
  unsigned letter = (byte(0) & 0x1FU) << 6U | (byte(1) & 0x3FU);
  if (letter == 0x3C2) letter = 0x3C3;  // final sigma
  const bool greek = letter >= 0x3B1 && letter <= 0x3C9;
  const bool cyrillic = letter >= 0x430 && letter <= 0x44F;
  const bool more_cyrillic = letter >= 0x450 && letter <= 0x45F;
  if (!greek && !cyrillic && !more_cyrillic) return std::nullopt;
  letter -= more_cyrillic ? 0x50 : 0x20;
  return std::string{static_cast<char>(0xC0U | letter >> 6U), static_cast<char>(0x80U | (letter & 0x3FU))};
}

}  // namespace

Key key_of(int code, char32_t typed, const LabelOfKey& label_of) {
  const Key place = at_place(code);
  if (code >= 0 && !is_printing(code)) return place;
  // a sign that was typed, shifted or not, then the label
  if (const Key key = named(typed); key != Key::Other) return key;
  if (code < 0) return Key::Other;
  if (const Key key = labelled(label_of(code)); key != Key::Other) return key;
  const bool number_row = place >= Key::Digit0 && place <= Key::Digit9;
  const bool lacks = !labelled_keys(label_of)[static_cast<std::size_t>(index(place))];
  return number_row || lacks ? place : Key::Other;
}

std::string letters_of(const LabelOfKey& label_of) {
  const auto has = labelled_keys(label_of);
  std::string letters;
  bool lacks = false;
  for (int code = GLFW_KEY_A; code <= GLFW_KEY_Z; ++code) {
    const bool labels = has[static_cast<std::size_t>(index(at_place(code)))];
    const auto own = labels ? std::nullopt : capital(label_of(code));
    lacks = lacks || own;
    letters += own.value_or(std::string(1, static_cast<char>('A' + code - GLFW_KEY_A)));
  }
  return lacks ? letters : std::string();
}

}  // namespace afm::render
