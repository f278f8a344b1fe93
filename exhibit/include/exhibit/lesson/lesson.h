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
#include "exhibit/lesson/push_plan.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/scale_modes.h"
#include "study/step_kind.h"

namespace afm::exhibit {

using study::kStepKinds;
using study::StepKind;

// The senses that a participant may use in a step.
enum class Condition { Haptics, Picture, Both, Sound };
struct ConditionRow {
  Condition condition;
  std::string_view word, meaning;
};
inline constexpr std::array kConditions{ConditionRow{Condition::Haptics, "haptics", "the force, without the picture"},
                                        ConditionRow{Condition::Picture, "picture", "the picture, without the force"},
                                        ConditionRow{Condition::Both, "both", "the force and the picture"},
                                        ConditionRow{Condition::Sound, "sound", "the force, the picture and tones"}};
static_assert(core::has_row_for_each(kConditions, &ConditionRow::condition));
constexpr std::string_view word_of(Condition condition) { return kConditions[core::index_of(condition)].word; }

// A text in every language of kLanguages, in that order.
struct LessonText {
  std::array<std::string, kLanguages.size()> texts;

  // `language`: one of kLanguages; any other returns the first text.
  const std::string& in(std::string_view language) const;
  bool empty() const { return texts.front().empty(); }
};

enum class Questionnaire { Paper, Sus, Tlx, Ssq };

// Rule that derives a threshold's next difference from the answers so far (exhibit/lesson/staircase.h).
enum class StaircaseRule { Weighted, OneUpThreeDown, Quest };

// Treatment of the release distances, which would reveal the stronger pull-off since Z_joc = F_ad/k'. Kept: stiffness
// and Hamaker constant grow with F_ad, so that Z_jtc and Z_joc are the same in both cycles. Roved: the stiffness is
// drawn at random for each cycle, so that Z_joc, stiffness and snap-in carry no information.
enum class DistanceCue { Kept, Roved };

struct ThresholdPlan {
  StaircaseRule rule = StaircaseRule::Weighted;
  DistanceCue distance = DistanceCue::Kept;
  double rove = 0;     // Roved: the stiffness is divided or multiplied by up to 1 + rove
  double start = 0.5;  // w of the first trial; the stronger F_ad is 1 + w times the standard's
  double least = 0.01, most = 1.0;
  double step = 1.25;  // divisor of w after a right answer; for 1-up-3-down, the final one
};

struct LessonStep {
  std::string id;
  StepKind kind = StepKind::Text;
  LessonText words;
  LessonText hint;  // may be empty
  double hint_after_s = 0;
  bool each_condition = false;         // repeated under each of the lesson's conditions
  std::vector<std::size_t> materials;  // indices into Lesson::materials
  int trials = 1;                      // counted ones; for Free, cycles to feel
  int practice = 0;                    // number before the counted trials
  ThresholdPlan threshold;
  Questionnaire questionnaire = Questionnaire::Paper;
  PushPlan push;
};

// Content of a lesson file. Const after loading; any thread.
struct Lesson {
  std::string id;  // lower-case letters, digits and dashes, for use in file names
  LessonText title;
  int minutes = 0;  // duration given by the author, 1 to kMostLessonMinutes
  std::vector<std::string> materials;
  scene::ScaleMode scale = scene::ScaleMode::Fit;  // Particles exactly if there are particles
  std::string particles;                           // as in ExhibitFiles; empty: none
  std::optional<scene::ParticleSet> set;           // those particles, all of them spheres
  std::vector<Condition> conditions;               // none, or at least two
  std::vector<LessonStep> steps;
  std::string digest;  // FNV-1a of the file, hexadecimal
};

inline constexpr int kMostLessonMinutes = 20;  // recommended limit for looking at stereo without a break

}  // namespace afm::exhibit
