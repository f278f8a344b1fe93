// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/enumerators.h"
#include "exhibit/frame/exhibit_files.h"
#include "scene/shared/scale_modes.h"
#include "study/step_kind.h"

namespace afm::exhibit {

using study::kStepKinds;
using study::StepKind;

// The senses that a step leaves a participant.
enum class Condition { Haptics, Picture, Both, Sound };
struct ConditionRow {
  Condition condition;
  std::string_view word;
};
inline constexpr std::array kConditions{ConditionRow{Condition::Haptics, "haptics"},
                                        ConditionRow{Condition::Picture, "picture"},
                                        ConditionRow{Condition::Both, "both"}, ConditionRow{Condition::Sound, "sound"}};
static_assert(core::has_row_for_each(kConditions, &ConditionRow::condition));
constexpr std::string_view word_of(Condition condition) { return kConditions[core::index_of(condition)].word; }

// A text in every language of kLanguages, in that order.
struct LessonText {
  std::array<std::string, kLanguages.size()> texts;

  // `language`: a word of kLanguages; of another one the first text.
  const std::string& in(std::string_view language) const;
  bool empty() const { return texts.front().empty(); }
};

enum class Questionnaire { Paper, Sus, Tlx, Ssq };

// The rule by which a threshold's next difference follows from the answers so far (exhibit/lesson/staircase.h).
enum class StaircaseRule { Weighted, OneUpThreeDown, Quest };

// What becomes of the distances over which the tip lets go, which would give the stronger pull-off away since
// Z_joc = F_ad/k'. Kept: stiffness and Hamaker constant grow with F_ad, so that Z_jtc and Z_joc are the same in both
// cycles. Roved: the stiffness is drawn anew for each cycle, and Z_joc, stiffness and snap-in say nothing.
enum class DistanceCue { Kept, Roved };

struct ThresholdPlan {
  StaircaseRule rule = StaircaseRule::Weighted;
  DistanceCue distance = DistanceCue::Kept;
  double rove = 0;     // of Roved: the stiffness is divided or multiplied by 1 + rove at most
  double start = 0.5;  // w of the first trial: the stronger F_ad is 1 + w times the standard's
  double least = 0.01, most = 1.0;
  double step = 1.25;  // by which w is divided after a right answer, 1-up-3-down: in the end
};

struct LessonStep {
  std::string id;
  StepKind kind = StepKind::Text;
  LessonText words;
  LessonText hint;  // may be empty
  double hint_after_s = 0;
  bool each_condition = false;         // done once under each of the lesson's conditions
  std::vector<std::size_t> materials;  // of Lesson::materials
  int trials = 1;                      // counted ones; of Free: cycles to be felt
  int practice = 0;                    // before them
  ThresholdPlan threshold;
  Questionnaire questionnaire = Questionnaire::Paper;
};

// A lesson file as it is read. Const after loading; any thread.
struct Lesson {
  std::string id;  // lower-case letters, digits and dashes: it is part of file names
  LessonText title;
  int minutes = 0;  // that it takes, as its author says: 1 to kMostLessonMinutes
  std::vector<std::string> materials;
  scene::ScaleMode scale = scene::ScaleMode::Fit;
  std::vector<Condition> conditions;  // none, or two and more
  std::vector<LessonStep> steps;
  std::string digest;  // of the file's bytes, hexadecimal
};

inline constexpr int kMostLessonMinutes = 20;  // as long as stereo should be looked at at a stretch

}  // namespace afm::exhibit
