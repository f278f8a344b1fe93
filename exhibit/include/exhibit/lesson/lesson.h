// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/enumerators.h"
#include "exhibit/frame/exhibit_files.h"
#include "scene/shared/scale_modes.h"
#include "study/step_kind.h"

namespace afm::curves {
struct TappedHand;
}
namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

struct LinesToWrite;
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
  double rove = 0;     // Roved only: largest change of the stiffness, which is divided or multiplied by up to 1 + rove
  double start = 0.5;  // w of the first trial; the stronger F_ad is 1 + w times the standard's
  double least = 0.01, most = 1.0;
  double step = 1.25;  // divisor of w after a right answer; for 1-up-3-down, the final one
};

// Events that end a step Push, once the tip has been lifted for scene::PatternTask::kRestNs; a loss ends it at once.
// Line and Threshold are done without the picture (scene::BlindTask).
enum class PushUntil { Moved, Target, Pattern, Lost, Line, Threshold };
struct PushUntilRow {
  PushUntil until;
  std::string_view word, meaning;
  bool from_targets;  // true: judged by the distance from targets, or from the line to one
};
inline constexpr std::array kPushUntils{
    PushUntilRow{PushUntil::Moved, "moved", "the particle is so far from its start", false},
    PushUntilRow{PushUntil::Target, "target", "the particle lies on a target", true},
    PushUntilRow{PushUntil::Pattern, "pattern", "the pattern of the set is done", true},
    PushUntilRow{PushUntil::Lost, "lost", "the tip has slipped past the particle", false},
    PushUntilRow{PushUntil::Line, "line", "without the picture: the particle is at least as far as a target", true},
    PushUntilRow{PushUntil::Threshold, "threshold",
                 "without the picture: a pinned particle has been pressed as hard as this one holds", false}};
static_assert(core::has_row_for_each(kPushUntils, &PushUntilRow::until));
constexpr const PushUntilRow& row_of(PushUntil until) { return kPushUntils[core::index_of(until)]; }

struct PushPlan {
  PushUntil until = PushUntil::Pattern;
  std::size_t particle = 0;  // index of the particle in the set; unused for Pattern
  std::size_t target = 0;    // index of its target in the set; Target and Line only
  double distance_m = 0;     // least distance from the start; Moved only
};

struct LessonStep {
  std::string id;
  StepKind kind = StepKind::Text;
  LessonText words;
  LessonText hint;  // may be empty
  double hint_after_s = 0;
  bool each_condition = false;         // true: repeated under each of the lesson's conditions
  std::vector<std::size_t> materials;  // indices into Lesson::materials
  int trials = 1;                      // number of counted trials; for Free, number of cycles to feel
  int practice = 0;                    // number of practice trials before the counted ones
  bool states = false;                 // true: asks for the state of a swing instead of the material; Identify only
  ThresholdPlan threshold;
  Questionnaire questionnaire = Questionnaire::Paper;
  PushPlan push;
  // lines for Write, never null there; shared, since a lesson is copied
  std::shared_ptr<const LinesToWrite> lines;
};

// Content of a lesson file. Const after loading; any thread.
struct Lesson {
  std::string id;  // lower-case letters, digits and dashes, for use in file names
  LessonText title;
  int minutes = 0;  // duration given by the author, 1 to kMostLessonMinutes
  std::vector<std::string> materials;
  scene::ScaleMode scale = scene::ScaleMode::Fit;  // scale of the hand; Particles if and only if there are particles
  std::string particles;                           // name as in ExhibitFiles; empty: none
  // these particles, all spheres, or this soft sample; null: none; shared, since a lesson is copied
  std::shared_ptr<const scene::ParticleSet> set;
  // lever in tapping mode, without particles; null: no tapping; shared, since a lesson is copied
  std::shared_ptr<const curves::TappedHand> tapping;
  std::vector<Condition> conditions;  // conditions of the study; none, or at least two
  std::vector<LessonStep> steps;
  std::string digest;  // FNV-1a of the file, its particle file and the user's materials, in hexadecimal
};

inline constexpr int kMostLessonMinutes = 20;  // recommended limit for looking at stereo without a break

}  // namespace afm::exhibit
