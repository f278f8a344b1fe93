// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "core/enumerators.h"
#include "exhibit/lesson/lesson_prompt.h"
#include "exhibit/words/phrases.h"
#include "render/frame.h"
#include "scene/display/wall.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// An instructor's actions in a running lesson, in the order of the keys 1 to 4. Next continues as the participant's
// Enter does; HandOff disables the force until it is pressed again.
enum class InstructorAction { Next, Skip, Stop, HandOff };
inline constexpr std::size_t kInstructorActions = core::kEnumerators<InstructorAction>.size();

// Content of the instructor's page. Hides the sample of a blind trial, so that the instructor cannot give it away.
struct InstructorState {
  LessonPrompt prompt{};
  std::string participant{};  // code; empty: anonymous, and nothing is stored
  double elapsed_s = 0;
  int planned_min = 0;
  std::size_t right = 0, judged = 0;  // number of counted trials that have a right answer
  scene::ServoState hand = scene::ServoState::Disarmed;
  bool stopped = false;  // true: stopped, as in Moment
  bool hand_off = false;
  bool stop_asked = false;  // true: Stop pressed once, awaiting confirmation
};

// Returns whether the action has an effect at this prompt.
bool acts(InstructorAction action, const LessonPrompt& prompt);

// A page of the instructor's window: a panel with the state and the participant's text, and a large target for each
// available action. Pure; any thread.
class InstructorPage {
 public:
  // `aspect`: width to height of the window.
  explicit InstructorPage(double aspect);

  // A frame of a scene without nodes. `pointed` is highlighted.
  render::FrameState frame(const InstructorState& state, std::optional<InstructorAction> pointed,
                           const Phrases& phrases) const;

  // The action whose target contains this place of the picture, in unit coordinates from its top left corner.
  std::optional<InstructorAction> action_at(const glm::dvec2& place, const LessonPrompt& prompt) const;

  static constexpr double kHeightM = 1.0;  // height of every page

 private:
  render::PanelPlacement target(InstructorAction action) const;

  scene::Screen screen_;
  std::array<scene::EyeView, 2> eyes_;
};

}  // namespace afm::exhibit
