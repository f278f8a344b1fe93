// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "core/enumerators.h"

namespace afm::study {

// Types of a lesson's steps, in one table for lesson files, their data, and the study that reads them
// (docs/adding-a-lesson-step.md).
enum class StepKind { Text, Free, Cycle, Identify, Threshold, Draw, Question, Push };
struct StepKindRow {
  StepKind kind;
  std::string_view word;  // in lesson files and in the column trial_type
  std::string_view meaning;
  bool compares_forces;  // answered by comparing forces on the hand: right or wrong, and only on the common scale
  bool open_ended;       // continues until someone ends it
  bool has_cycles;       // the tip snaps in and lets go in each trial
};
inline constexpr std::array kStepKinds{
    StepKindRow{StepKind::Text, "text", "a text to read", false, false, false},
    StepKindRow{StepKind::Free, "free", "exploration at will", false, true, true},
    StepKindRow{StepKind::Cycle, "cycle", "a guided cycle", false, false, true},
    StepKindRow{StepKind::Identify, "identify", "a hidden sample, to be named", true, false, true},
    StepKindRow{StepKind::Threshold, "threshold", "two cycles, of which the one that let go harder is to be named",
                true, false, true},
    StepKindRow{StepKind::Draw, "draw", "the curve, put together from its parts", false, false, false},
    StepKindRow{StepKind::Question, "question", "an item of a questionnaire", false, false, false},
    StepKindRow{StepKind::Push, "push", "a particle to push, or all to form their pattern", false, false, false}};
static_assert(core::has_row_for_each(kStepKinds, &StepKindRow::kind));
constexpr const StepKindRow& row_of(StepKind kind) { return kStepKinds[core::index_of(kind)]; }
constexpr std::string_view word_of(StepKind kind) { return row_of(kind).word; }

}  // namespace afm::study
