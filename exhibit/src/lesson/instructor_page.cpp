// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/instructor_page.h"

#include <fmt/format.h>

#include <cmath>

#include "exhibit/frame/wall_pictures.h"
#include "exhibit/lesson/lesson_panel.h"
#include "exhibit/state/moment.h"

namespace afm::exhibit {

namespace {

constexpr double kEyeM = 2.0;        // distance of the eyes in front of the page
constexpr double kBorder = 0.02;     // relative to the page's height
constexpr double kTargetHigh = 0.1;  // relative to the page's height
constexpr double kLetterM = 0.024;   // mean width of a letter

using Wants = LessonPrompt::Wants;

Phrase awaited(Wants wants) {
  switch (wants) {
    case Wants::GoOn:
      return Phrase::InstructorWaitsGoOn;
    case Wants::Cycle:
      return Phrase::InstructorWaitsCycle;
    case Wants::Push:
      return Phrase::InstructorWaitsPush;
    case Wants::Write:
      return Phrase::InstructorWaitsWrite;
    case Wants::Answer:
      return Phrase::InstructorWaitsAnswer;
    case Wants::Nothing:
      break;
  }
  return Phrase::InstructorWaitsNothing;
}

const std::string& text_of(InstructorAction action, const InstructorState& state, const Phrases& phrases) {
  if (action == InstructorAction::Stop && state.stop_asked) return phrases[Phrase::InstructorReallyStop];
  if (action == InstructorAction::HandOff && state.hand_off) return phrases[Phrase::InstructorHandOn];
  return phrases[after(Phrase::InstructorNext, core::index_of(action))];
}

render::DataPanel panel_of(const InstructorState& state, std::size_t letters, const Phrases& phrases) {
  const LessonPrompt& prompt = state.prompt;
  render::DataPanel panel{
      .title = phrases.text<Phrase::InstructorTitle>(prompt.title), .subtitle = prompt.progress, .rows = {}};
  const auto add = [&](Phrase name, std::string value) { panel.rows.push_back({phrases[name], std::move(value), ""}); };
  add(Phrase::InstructorParticipant, state.participant.empty() ? phrases[Phrase::InstructorNobody] : state.participant);
  add(Phrase::InstructorWaits, phrases[awaited(prompt.wants)]);
  add(Phrase::InstructorForce,
      phrases[state.hand_off ? Phrase::InstructorForceKeptOff : state_phrase(state.hand, state.stopped)]);
  add(Phrase::InstructorTime,
      phrases.text<Phrase::InstructorMinutes>(fmt::format("{:.0f}", std::floor(state.elapsed_s / 60.0)),
                                              std::to_string(state.planned_min)));
  if (state.judged > 0) {
    add(Phrase::InstructorRight,
        phrases.text<Phrase::InstructorShare>(std::to_string(state.right), std::to_string(state.judged)));
  }
  add_lines(prompt.words, letters, panel.rows);
  add_lines(prompt.hint, letters, panel.rows);
  return panel;
}

}  // namespace

bool acts(InstructorAction action, const LessonPrompt& prompt) {
  switch (action) {
    case InstructorAction::Next:
      return prompt.wants == Wants::GoOn || (prompt.in_step && row_of(prompt.kind).open_ended);
    case InstructorAction::Skip:
      return prompt.in_step;
    case InstructorAction::Stop:
      return prompt.wants != Wants::Nothing;
    case InstructorAction::HandOff:
      break;
  }
  return true;
}

InstructorPage::InstructorPage(double aspect) {
  const double half_m = 0.5 * kHeightM * aspect;
  screen_ = {.name = "instructor",
             .lower_left = {-half_m, 0.0, 0.0},
             .lower_right = {half_m, 0.0, 0.0},
             .upper_left = {-half_m, kHeightM, 0.0}};
  eyes_ = eyes_before(screen_, {.position_m = {0.0, 0.5 * kHeightM, kEyeM}}, 0.0).value();
}

// Two rows of two targets below the panel.
render::PanelPlacement InstructorPage::target(InstructorAction action) const {
  constexpr double kGapM = kBorder * kHeightM, kHighM = kTargetHigh * kHeightM;
  const std::size_t index = core::index_of(action);
  const double width_m = 0.5 * (screen_.width_m() - 3.0 * kGapM);
  const double left_m = kGapM + static_cast<double>(index % 2) * (width_m + kGapM);
  const double bottom_m = kGapM + (index < 2 ? kHighM + kGapM : 0.0);
  return {.lower_left_m = screen_.lower_left + glm::dvec3(left_m, bottom_m, 0.0),
          .right_m = {width_m, 0.0, 0.0},
          .up_m = {0.0, kHighM, 0.0}};
}

render::FrameState InstructorPage::frame(const InstructorState& state, std::optional<InstructorAction> pointed,
                                         const Phrases& phrases) const {
  constexpr double kGapM = kBorder * kHeightM, kBelowM = 3.0 * kGapM + 2.0 * kTargetHigh * kHeightM;
  render::FrameState frame;
  frame.eyes = eyes_;
  const double width_m = screen_.width_m() - 2.0 * kGapM;
  frame.panels.data.placement = {.lower_left_m = screen_.lower_left + glm::dvec3(kGapM, kBelowM, 0.0),
                                 .right_m = {width_m, 0.0, 0.0},
                                 .up_m = {0.0, kHeightM - kBelowM - kGapM, 0.0}};
  frame.panels.data.content = panel_of(state, static_cast<std::size_t>(width_m / kLetterM), phrases);
  for (const InstructorAction action : core::kEnumerators<InstructorAction>) {
    if (!acts(action, state.prompt)) continue;
    frame.labels.push_back({.text = fmt::format("{}  {}", core::index_of(action) + 1, text_of(action, state, phrases)),
                            .highlighted = pointed == action || (action == InstructorAction::HandOff && state.hand_off),
                            .placement = target(action)});
  }
  return frame;
}

std::optional<InstructorAction> InstructorPage::action_at(const glm::dvec2& place, const LessonPrompt& prompt) const {
  const glm::dvec2 at_m(place.x * screen_.width_m() + screen_.lower_left.x, (1.0 - place.y) * kHeightM);
  for (const InstructorAction action : core::kEnumerators<InstructorAction>) {
    const render::PanelPlacement where = target(action);
    const glm::dvec2 from_m = at_m - glm::dvec2(where.lower_left_m);
    const bool inside = from_m.x >= 0.0 && from_m.y >= 0.0 && from_m.x <= where.right_m.x && from_m.y <= where.up_m.y;
    if (inside && acts(action, prompt)) return action;
  }
  return std::nullopt;
}

}  // namespace afm::exhibit
