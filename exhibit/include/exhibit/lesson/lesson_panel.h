// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "exhibit/lesson/lesson_prompt.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"

namespace afm::exhibit {

// A large target to point at. Answer: the answer number `answer`. A scale has three targets: one step down, the marked
// value, which answers, and one step up.
struct LessonTarget {
  enum class Action { Answer, Less, Confirm, More, GoOn };
  Action action = Action::Answer;
  std::size_t answer = 0;
  std::string text;
  bool marked = false;
};

// Largest number of answers numbered for keys 1 to 9; more of them form a scale.
inline constexpr std::size_t kMostNumberedAnswers = 9;

bool is_scale(const LessonPrompt& prompt);

// The targets of a prompt. `marked` is the marked answer; a scale always has one.
std::vector<LessonTarget> lesson_targets(const LessonPrompt& prompt, std::optional<std::size_t> marked,
                                         const Phrases& phrases);

// The prompt as a panel: title, progress, words and hint in lines, and how to answer.
render::DataPanel lesson_panel(const LessonPrompt& prompt, const Phrases& phrases);

// Adds the text as rows of at most `letters` letters.
void add_lines(std::string_view text, std::size_t letters, std::vector<render::DataRow>& rows);

// A panel divided for a number of targets: the words above, the targets below each other.
struct LessonPlaces {
  render::PanelPlacement words;
  std::vector<render::PanelPlacement> targets;
};
LessonPlaces lesson_places(const render::PanelPlacement& whole, std::size_t targets);

// Speech for a prompt: its words, its hint and its numbered answers, or a scale's initial value.
std::string lesson_speech(const LessonPrompt& prompt, const Phrases& phrases);

}  // namespace afm::exhibit
