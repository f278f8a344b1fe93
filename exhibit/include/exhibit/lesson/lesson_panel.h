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

// A large target to point at. Answer: the one of that number. A scale has three: one step less, the marked value, which
// answers, and one step more.
struct LessonTarget {
  enum class Action { Answer, Less, Confirm, More, GoOn };
  Action action = Action::Answer;
  std::size_t answer = 0;
  std::string text;
  bool marked = false;
};

// As many answers as keys 1 to 9 have are chosen at once; more are a scale.
inline constexpr std::size_t kMostNumberedAnswers = 9;

bool is_scale(const LessonPrompt& prompt);

// The targets of a prompt; `marked` is the answer under the mark, which a scale always has.
std::vector<LessonTarget> lesson_targets(const LessonPrompt& prompt, std::optional<std::size_t> marked,
                                         const Phrases& phrases);

// The guide's words as a panel: title, progress, words and hint in lines, and how to answer.
render::DataPanel lesson_panel(const LessonPrompt& prompt, const Phrases& phrases);

// Adds the words as rows of at most so many letters.
void add_lines(std::string_view text, std::size_t letters, std::vector<render::DataRow>& rows);

// A panel divided for so many targets: the words above, the targets below, one under the other.
struct LessonPlaces {
  render::PanelPlacement words;
  std::vector<render::PanelPlacement> targets;
};
LessonPlaces lesson_places(const render::PanelPlacement& whole, std::size_t targets);

// What is spoken of a prompt: its words, its hint and its answers with their numbers, of a scale where it begins.
std::string lesson_speech(const LessonPrompt& prompt, const Phrases& phrases);

}  // namespace afm::exhibit
