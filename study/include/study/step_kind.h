// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

#include "core/enumerators.h"

namespace afm::study {

// Types of a lesson's steps, in one table for lesson files, their data, and the study that reads them
// (docs/adding-a-lesson-step.md).
enum class StepKind { Text, Free, Cycle, Identify, Threshold, Draw, Question, Push, Write };
// Answer to a counted trial. Comparison: judgement of forces on the hand, which is right or wrong, and needs the common
// scale. Number: StudyTrial::value.
enum class StepAnswer { None, Number, Comparison };

// Ground on which the tip of a lesson works: the lesson's materials, the particles on one of them, or a soft sample
// that it marks. Any: the step goes with each of them.
enum class StepGround { Any, Materials, Particles, SoftSample };

// Use of a step in a lesson with a lever that taps.
enum class StepBeside { Allowed, Needed, Refused };

struct StepKindRow {
  StepKind kind;
  std::string_view word;  // spelling in lesson files and in the column trial_type
  std::string_view meaning;
  StepAnswer answer;
  bool open_ended;  // true: continues until someone ends it
  bool has_cycles;  // true: the tip snaps in and pulls off in each trial
  StepGround ground;
  StepBeside tapping;
};
inline constexpr std::array kStepKinds{
    StepKindRow{.kind = StepKind::Text,
                .word = "text",
                .meaning = "a text to read",
                .answer = StepAnswer::None,
                .open_ended = false,
                .has_cycles = false,
                .ground = StepGround::Any,
                .tapping = StepBeside::Allowed},
    StepKindRow{.kind = StepKind::Free,
                .word = "free",
                .meaning = "exploration at will",
                .answer = StepAnswer::None,
                .open_ended = true,
                .has_cycles = true,
                .ground = StepGround::Materials,
                .tapping = StepBeside::Allowed},
    StepKindRow{.kind = StepKind::Cycle,
                .word = "cycle",
                .meaning = "a guided cycle",
                .answer = StepAnswer::Number,
                .open_ended = false,
                .has_cycles = true,
                .ground = StepGround::Materials,
                .tapping = StepBeside::Refused},
    StepKindRow{.kind = StepKind::Identify,
                .word = "identify",
                .meaning = "a hidden sample, to be named",
                .answer = StepAnswer::Comparison,
                .open_ended = false,
                .has_cycles = true,
                .ground = StepGround::Materials,
                .tapping = StepBeside::Allowed},
    StepKindRow{.kind = StepKind::Threshold,
                .word = "threshold",
                .meaning = "two cycles, of which the one with the stronger pull-off is to be named",
                .answer = StepAnswer::Comparison,
                .open_ended = false,
                .has_cycles = true,
                .ground = StepGround::Materials,
                .tapping = StepBeside::Refused},
    StepKindRow{.kind = StepKind::Draw,
                .word = "draw",
                .meaning = "the curve, put together from its parts",
                .answer = StepAnswer::Number,
                .open_ended = false,
                .has_cycles = false,
                .ground = StepGround::Any,
                .tapping = StepBeside::Refused},
    StepKindRow{.kind = StepKind::Question,
                .word = "question",
                .meaning = "an item of a questionnaire",
                .answer = StepAnswer::Number,
                .open_ended = false,
                .has_cycles = false,
                .ground = StepGround::Any,
                .tapping = StepBeside::Allowed},
    StepKindRow{.kind = StepKind::Push,
                .word = "push",
                .meaning = "a particle to push, or all to form their pattern",
                .answer = StepAnswer::Number,
                .open_ended = false,
                .has_cycles = false,
                .ground = StepGround::Particles,
                .tapping = StepBeside::Refused},
    StepKindRow{.kind = StepKind::Write,
                .word = "write",
                .meaning = "lines to be scratched or written with ink",
                .answer = StepAnswer::Number,
                .open_ended = false,
                .has_cycles = false,
                .ground = StepGround::SoftSample,
                .tapping = StepBeside::Refused}};
static_assert(core::has_row_for_each(kStepKinds, &StepKindRow::kind));
constexpr const StepKindRow& row_of(StepKind kind) { return kStepKinds[core::index_of(kind)]; }
constexpr std::string_view word_of(StepKind kind) { return row_of(kind).word; }

}  // namespace afm::study
