// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "core/enumerators.h"
#include "exhibit/lesson/lesson_prompt.h"
#include "exhibit/phrases.h"
#include "render/frame.h"
#include "scene/display/wall.h"
#include "scene/shared/tip_blocks.h"

namespace afm::exhibit {

// What an instructor may do with a lesson under way, in the order of the keys 1 to 4. Next goes on where the
// participant would press Enter; HandOff keeps the force off the hand until it is pressed again.
enum class InstructorAction { Next, Skip, Stop, HandOff };
inline constexpr std::size_t kInstructorActions = core::kEnumerators<InstructorAction>.size();

// What the instructor's page shows of it. It never says which sample a blind trial has: an instructor who does not know
// gives nothing away.
struct InstructorState {
  LessonPrompt prompt{};
  std::string participant{};  // code; empty: nobody, and nothing is kept
  double elapsed_s = 0;
  int planned_min = 0;
  std::size_t right = 0, judged = 0;  // of the counted trials that have a right answer
  scene::ServoState hand = scene::ServoState::Disarmed;
  bool stopped = false;  // as in Moment
  bool hand_off = false;
  bool stop_asked = false;  // Stop was pressed once
};

// Whether it does anything at this prompt.
bool acts(InstructorAction action, const LessonPrompt& prompt);

// A page of the instructor's window: a panel with the state and with the words that the participant has, and a large
// target for each action that acts. Pure; any thread.
class InstructorPage {
 public:
  // `aspect`: width to height of the window.
  explicit InstructorPage(double aspect);

  // A frame of a scene without nodes; `pointed` is drawn as marked.
  render::FrameState frame(const InstructorState& state, std::optional<InstructorAction> pointed,
                           const Phrases& phrases) const;

  // The action whose target holds this place of the picture, in unit coordinates from its top left corner.
  std::optional<InstructorAction> action_at(const glm::dvec2& place, const LessonPrompt& prompt) const;

  static constexpr double kHeightM = 1.0;  // of every page

 private:
  render::PanelPlacement target(InstructorAction action) const;

  scene::Screen screen_;
  std::array<scene::EyeView, 2> eyes_;
};

}  // namespace afm::exhibit
