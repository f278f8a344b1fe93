// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/lesson_panel.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "core/printable.h"

namespace afm::exhibit {

namespace {

constexpr double kTargetsShare = 0.5;  // largest fraction of the panel's height for all targets
constexpr double kTargetShare = 0.14;  // largest fraction for one target
constexpr double kGapShare = 0.08;     // gap between two targets, relative to a target

}  // namespace

bool is_scale(const LessonPrompt& prompt) { return prompt.answers.size() > kMostNumberedAnswers; }

void add_lines(std::string_view text, std::size_t letters, std::vector<render::DataRow>& rows) {
  std::string line;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    if (!line.empty() && core::count_characters(line) + 1 + core::count_characters(word) > letters) {
      rows.push_back({std::move(line), "", ""});
      line.clear();
    }
    line += (line.empty() ? "" : " ") + std::string(word);
  }
  if (!line.empty()) rows.push_back({std::move(line), "", ""});
}

std::vector<LessonTarget> lesson_targets(const LessonPrompt& prompt, std::optional<std::size_t> marked,
                                         const Phrases& phrases) {
  using Action = LessonTarget::Action;
  if (prompt.wants == LessonPrompt::Wants::GoOn) return {{Action::GoOn, 0, phrases[Phrase::LessonPressEnter]}};
  if (prompt.wants != LessonPrompt::Wants::Answer) return {};
  if (is_scale(prompt)) {
    const std::size_t mark = marked.value_or(prompt.marked);
    return {{Action::Less, 0, "\u2212"}, {Action::Confirm, mark, prompt.answers[mark], true}, {Action::More, 0, "+"}};
  }
  std::vector<LessonTarget> targets;
  targets.reserve(prompt.answers.size());
  for (std::size_t i = 0; i < prompt.answers.size(); ++i) {
    targets.push_back({Action::Answer, i, fmt::format("{}  {}", i + 1, prompt.answers[i]), marked == i});
  }
  return targets;
}

render::DataPanel lesson_panel(const LessonPrompt& prompt, const Phrases& phrases) {
  render::DataPanel panel{.title = prompt.title, .subtitle = prompt.progress, .rows = {}};
  if (!prompt.words.empty()) panel.rows.push_back({prompt.words, "", ""});
  if (!prompt.hint.empty()) panel.rows.push_back({prompt.hint, "", ""});
  if (prompt.wants == LessonPrompt::Wants::Answer) {
    panel.rows.push_back({phrases[is_scale(prompt) ? Phrase::LessonPressScale : Phrase::LessonPressNumber], "", ""});
  }
  return panel;
}

LessonPlaces lesson_places(const render::PanelPlacement& whole, std::size_t targets) {
  LessonPlaces places{.words = whole, .targets = {}};
  if (targets == 0) return places;
  const double each = std::min(kTargetShare, kTargetsShare / static_cast<double>(targets));
  for (std::size_t i = 0; i < targets; ++i) {
    const double bottom = each * static_cast<double>(targets - 1 - i);
    places.targets.push_back({.lower_left_m = whole.lower_left_m + bottom * whole.up_m,
                              .right_m = whole.right_m,
                              .up_m = (1.0 - kGapShare) * each * whole.up_m});
  }
  const double below = each * static_cast<double>(targets);
  places.words.lower_left_m += below * whole.up_m;
  places.words.up_m *= 1.0 - below;
  return places;
}

std::string lesson_speech(const LessonPrompt& prompt, const Phrases& phrases) {
  std::string text = prompt.words;
  if (!prompt.hint.empty()) text += " " + prompt.hint;
  if (prompt.wants == LessonPrompt::Wants::GoOn) text += " " + phrases[Phrase::LessonPressEnter] + ".";
  if (prompt.wants != LessonPrompt::Wants::Answer) return text;
  if (is_scale(prompt)) return text + " " + phrases[Phrase::LessonPressScale] + ". " + prompt.answers[prompt.marked];
  for (std::size_t i = 0; i < prompt.answers.size(); ++i) text += fmt::format(" {}: {}.", i + 1, prompt.answers[i]);
  return text;
}

}  // namespace afm::exhibit
