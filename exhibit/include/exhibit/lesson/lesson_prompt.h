// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "exhibit/lesson/lesson.h"
#include "scene/shared/shared_blocks.h"

namespace afm::exhibit {

// The newest cycle of the tip: snapped in and let go.
struct FeltCycle {
  std::size_t material = 0;
  double f_ad_n = 0;  // magnitude
};

// What a lesson asks of its participant now.
struct LessonPrompt {
  enum class Wants { GoOn, Cycle, Answer, Nothing };
  Wants wants = Wants::GoOn;
  std::string title, words, hint, progress;     // the hint is empty until its time
  std::vector<std::string> answers;             // of Wants::Answer; more than nine are a scale
  std::size_t marked = 0;                       // where the scale begins
  std::optional<std::size_t> material;          // to be under the tip
  std::optional<scene::SharedContact> variant;  // its parameters; none: as loaded
  std::size_t task = 0;                         // another number for every step
  std::uint32_t cycle = 0;                      // another number for every cycle that is wanted
  bool in_step = false;                         // neither consent, break nor end
  bool hidden = false;                          // names, curves, figures and sounds would give the answer away
  std::optional<Condition> condition;
  // for a participant that is simulated
  StepKind kind = StepKind::Text;
  std::string item;       // of a questionnaire
  std::size_t right = 0;  // the right answer, if there is one
  bool has_right = false;
};

}  // namespace afm::exhibit
