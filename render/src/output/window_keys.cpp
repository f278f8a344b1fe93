// SPDX-License-Identifier: Apache-2.0
#include "output/window_keys.h"

#include <algorithm>
#include <array>

#include "output/window_system.h"

namespace afm::render {

namespace {

// Run of keys within which GLFW's codes and Key count up together.
struct KeyRun {
  int first_code, last_code;
  Key first, last;
};

constexpr int index(Key key) { return static_cast<int>(key); }

// Runs in the order of Key.
constexpr std::array kRuns{
    KeyRun{GLFW_KEY_SPACE, GLFW_KEY_SPACE, Key::Space, Key::Space},
    KeyRun{GLFW_KEY_APOSTROPHE, GLFW_KEY_APOSTROPHE, Key::Apostrophe, Key::Apostrophe},
    KeyRun{GLFW_KEY_COMMA, GLFW_KEY_9, Key::Comma, Key::Digit9},
    KeyRun{GLFW_KEY_SEMICOLON, GLFW_KEY_SEMICOLON, Key::Semicolon, Key::Semicolon},
    KeyRun{GLFW_KEY_EQUAL, GLFW_KEY_EQUAL, Key::Equal, Key::Equal},
    KeyRun{GLFW_KEY_A, GLFW_KEY_RIGHT_BRACKET, Key::A, Key::RightBracket},
    KeyRun{GLFW_KEY_GRAVE_ACCENT, GLFW_KEY_GRAVE_ACCENT, Key::GraveAccent, Key::GraveAccent},
    KeyRun{GLFW_KEY_ESCAPE, GLFW_KEY_END, Key::Escape, Key::End},
    KeyRun{GLFW_KEY_F1, GLFW_KEY_F12, Key::F1, Key::F12},
};

constexpr bool every_key_has_a_code() {
  int next = index(Key::Other) + 1;
  for (const KeyRun& run : kRuns) {
    if (index(run.first) != next || index(run.last) - index(run.first) != run.last_code - run.first_code) return false;
    next = index(run.last) + 1;
  }
  return next == index(Key::F12) + 1;
}
static_assert(every_key_has_a_code());

}  // namespace

Key key_of(int glfw_code) {
  const auto run = std::find_if(kRuns.begin(), kRuns.end(), [glfw_code](const KeyRun& candidate) {
    return glfw_code >= candidate.first_code && glfw_code <= candidate.last_code;
  });
  if (run == kRuns.end()) return Key::Other;
  return static_cast<Key>(index(run->first) + glfw_code - run->first_code);
}

}  // namespace afm::render
