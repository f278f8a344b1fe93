// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "core/enumerators.h"

namespace afm::study {

// Types of a lesson's steps, in one table for lesson files, their data, and the study that reads them
// (docs/adding-a-lesson-step.md).
enum class StepKind { Text, Free, Cycle, Identify, Threshold, Draw, Question };
struct StepKindRow {
  StepKind kind;
  std::string_view word;  // in lesson files and in the column trial_type
  bool compares_forces;   // answered by comparing forces on the hand: right or wrong, and only on the common scale
  bool open_ended;        // continues until someone ends it
};
inline constexpr std::array kStepKinds{StepKindRow{StepKind::Text, "text", false, false},
                                       StepKindRow{StepKind::Free, "free", false, true},
                                       StepKindRow{StepKind::Cycle, "cycle", false, false},
                                       StepKindRow{StepKind::Identify, "identify", true, false},
                                       StepKindRow{StepKind::Threshold, "threshold", true, false},
                                       StepKindRow{StepKind::Draw, "draw", false, false},
                                       StepKindRow{StepKind::Question, "question", false, false}};
static_assert(core::has_row_for_each(kStepKinds, &StepKindRow::kind));
constexpr const StepKindRow& row_of(StepKind kind) { return kStepKinds[core::index_of(kind)]; }
constexpr std::string_view word_of(StepKind kind) { return row_of(kind).word; }

}  // namespace afm::study
