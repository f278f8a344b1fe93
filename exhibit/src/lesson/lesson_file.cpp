// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/lesson_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <set>
#include <utility>

#include "core/enumerators.h"
#include "core/fnv1a.h"
#include "core/whole_file.h"
#include "exhibit/lesson/questionnaire.h"
#include "exhibit/state/lines_to_write.h"
#include "lesson_particles.h"
#include "lesson_tapping.h"
#include "physics/quantity_text.h"
#include "scene/config/toml_file.h"
#include "scene/config/toml_table.h"
#include "scene/samples/particle_files.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

namespace {

using scene::TomlTable;
using study::StepAnswer;

constexpr const char* kKind = "lesson file";
constexpr std::size_t kMostSteps = 100, kMostIdLetters = 40, kMostConditions = 4;
constexpr int kMostTrials = 200, kMostPractice = 20;
constexpr double kLongestHintS = 600;

// Reads a part of file names, or of columns.
std::string read_id(const TomlTable& table, std::string_view key) {
  std::string value = table.text(key, kMostIdLetters);
  const bool plain = std::all_of(value.begin(), value.end(),
                                 [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
  if (!plain || value.front() == '-') table.refuse(key, "must be lower-case letters, digits and dashes");
  return value;
}

// Reads a text for each language.
LessonText read_words(const TomlTable& table, std::string_view key, std::size_t limit) {
  std::vector<std::string_view> known;
  std::string how;
  for (const LanguageRow& row : kLanguages) {
    known.push_back(row.word);
    how += fmt::format("{}{} = \"...\"", how.empty() ? "{ " : ", ", row.word);
  }
  const TomlTable languages = table.table(key, how + " }");
  languages.allow_only(known, "language");
  LessonText words;
  for (std::size_t i = 0; i < kLanguages.size(); ++i) words.texts[i] = languages.text(kLanguages[i].word, limit);
  return words;
}

int whole_or(const TomlTable& table, std::string_view key, int least, int most, int fallback) {
  return table.has(key) ? static_cast<int>(table.whole(key, least, most)) : fallback;
}

double number_or(const TomlTable& table, std::string_view key, double least, double most, double fallback) {
  return table.has(key) ? table.number(key, least, most) : fallback;
}

double read_time_s(const TomlTable& table, std::string_view key, double most_s) {
  const double time_s = table.quantity(key, physics::kTimeUnits).si;
  if (!(time_s >= 0.0) || time_s > most_s) table.refuse(key, fmt::format("must lie between 0 s and {:g} s", most_s));
  return time_s;
}

struct ScaleWord {
  scene::ScaleMode mode;
  std::string_view word;
};
// Every scale except that of atoms, on which no hand can compare two materials.
constexpr auto kLessonScales = [] {
  std::array<ScaleWord, scene::kScalesOfSamples.size() - 1> rows{};
  std::size_t count = 0;
  for (const scene::ScaleModeText& row : scene::kScalesOfSamples) {
    if (row.mode != scene::ScaleMode::Atoms) rows.at(count++) = {row.mode, row.word};
  }
  return rows;
}();

struct RuleWord {
  StaircaseRule rule;
  std::string_view word;
};
constexpr std::array kRules{RuleWord{StaircaseRule::Weighted, "weighted"},
                            RuleWord{StaircaseRule::OneUpThreeDown, "1-up-3-down"},
                            RuleWord{StaircaseRule::Quest, "quest"}};
static_assert(core::has_row_for_each(kRules, &RuleWord::rule));

struct CueWord {
  DistanceCue cue;
  std::string_view word;
};
constexpr std::array kCues{CueWord{DistanceCue::Kept, "kept"}, CueWord{DistanceCue::Roved, "roved"}};
static_assert(core::has_row_for_each(kCues, &CueWord::cue));

enum class SsqMoment { Before, After };
struct MomentWord {
  SsqMoment moment;
  std::string_view word;
};
constexpr std::array kMoments{MomentWord{SsqMoment::Before, "before"}, MomentWord{SsqMoment::After, "after"}};
static_assert(core::has_row_for_each(kMoments, &MomentWord::moment));

ThresholdPlan read_threshold(const TomlTable& table) {
  ThresholdPlan plan;
  plan.rule = table.one_of("staircase", kRules, &RuleWord::word).rule;
  plan.distance = table.one_of("distance", kCues, &CueWord::word).cue;
  if (plan.distance == DistanceCue::Roved) {
    plan.rove = table.number("rove", 0.05, 1.0);
  } else if (table.has("rove")) {
    table.refuse("rove", "is for distance = \"roved\" alone");
  }
  plan.least = number_or(table, "least", 1e-3, 1.0, plan.least);
  plan.most = number_or(table, "most", 1e-2, 5.0, plan.most);
  plan.start = number_or(table, "start", 1e-3, 5.0, plan.start);
  plan.step = number_or(table, "step", 1.01, 4.0, plan.step);
  if (!(plan.least < plan.most)) table.refuse("least", "must be below most");
  if (plan.start < plan.least || plan.start > plan.most) table.refuse("start", "must lie between least and most");
  return plan;
}

// Reads the materials of a step, as indices into the lesson's list.
std::vector<std::size_t> read_materials(const TomlTable& table, const LessonStep& step, const Lesson& lesson) {
  std::vector<std::size_t> places;
  const auto place_of = [&](std::string_view key, const std::string& name) {
    const auto found = std::find(lesson.materials.begin(), lesson.materials.end(), name);
    if (found == lesson.materials.end()) {
      table.refuse(key,
                   fmt::format("{} is none of the lesson's materials: {}", name, fmt::join(lesson.materials, ", ")));
    }
    places.push_back(static_cast<std::size_t>(found - lesson.materials.begin()));
  };
  if (step.kind == StepKind::Cycle || step.kind == StepKind::Threshold || step.states) {
    place_of("material", table.text("material", kMostIdLetters));
    return places;
  }
  if (table.has("materials")) {
    for (const std::string& name : table.texts("materials", kMostMaterials)) place_of("materials", name);
  } else {
    for (const std::string& name : lesson.materials) place_of("materials", name);
  }
  if (step.kind == StepKind::Identify && places.size() < 2) {
    table.refuse(table.has("materials") ? "materials" : "type", "needs two materials or more to tell apart");
  }
  return places;
}

void read_questionnaire(const TomlTable& table, LessonStep& step) {
  const QuestionnaireRow& row = table.one_of("questionnaire", kQuestionnaires, &QuestionnaireRow::word);
  step.questionnaire = row.questionnaire;
  if (row.questionnaire != Questionnaire::Ssq) {
    if (table.has("when")) table.refuse("when", "is for the questionnaire ssq alone");
    return;
  }
  const std::string ending = "-" + std::string(table.one_of("when", kMoments, &MomentWord::word).word);
  if (!step.id.ends_with(ending)) table.refuse("id", fmt::format("of this step must end in {}", ending));
}

void refuse_picture(const TomlTable& table, const Lesson& lesson, const LessonStep& step, std::string_view what) {
  const auto& conditions = lesson.conditions;
  const bool has_picture = std::find(conditions.begin(), conditions.end(), Condition::Picture) != conditions.end();
  if (!step.each_condition || !has_picture) return;
  table.refuse("each_condition", fmt::format("is impossible for {}: the condition picture takes the force away", what));
}

// Allows the keys of each kind of step, in addition to those of all steps.
void allow_keys(const TomlTable& table, StepKind kind) {
  switch (kind) {
    case StepKind::Text:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition"});
    case StepKind::Free:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "materials", "cycles"});
    case StepKind::Cycle:
      return table.allow_only(
          {"id", "type", "words", "hint", "hint_after", "each_condition", "material", "trials", "practice"});
    case StepKind::Identify:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "materials", "trials",
                               "practice", "of", "material"});
    case StepKind::Threshold:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "material", "trials",
                               "practice", "staircase", "distance", "rove", "start", "least", "most", "step"});
    case StepKind::Draw:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "trials", "practice"});
    case StepKind::Question:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "questionnaire", "when"});
    case StepKind::Push:
      return table.allow_only(
          {"id", "type", "words", "hint", "hint_after", "each_condition", "until", "particle", "target", "distance"});
    case StepKind::Write:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "lines", "width"});
  }
}

void read_common(const TomlTable& table, const Lesson& lesson, LessonStep& step) {
  step.id = read_id(table, "id");
  step.words = read_words(table, "words", kParagraph);
  if (table.has("hint")) step.hint = read_words(table, "hint", kParagraph);
  if (table.has("hint") != table.has("hint_after")) {
    table.refuse(table.has("hint") ? "hint" : "hint_after", "needs both hint and hint_after");
  }
  if (table.has("hint_after")) step.hint_after_s = read_time_s(table, "hint_after", kLongestHintS);
  step.each_condition = table.has("each_condition") && table.flag("each_condition");
  if (step.each_condition && lesson.conditions.empty()) {
    table.refuse("each_condition", "needs the lesson's conditions");
  }
}

LessonStep read_step(const TomlTable& table, const Lesson& lesson) {
  LessonStep step;
  const study::StepKindRow& row = table.one_of("type", kStepKinds, &study::StepKindRow::word);
  step.kind = row.kind;
  refuse_kind_on_ground(table, row, lesson);
  refuse_kind_beside_tapping(table, row, lesson);
  allow_keys(table, step.kind);
  read_common(table, lesson, step);
  step.trials = step.kind == StepKind::Free ? whole_or(table, "cycles", 1, kMostTrials, 1)
                                            : whole_or(table, "trials", 1, kMostTrials, 1);
  step.practice = whole_or(table, "practice", 0, kMostPractice, 0);
  switch (step.kind) {
    case StepKind::Text:
    case StepKind::Draw:
      break;
    case StepKind::Question:
      read_questionnaire(table, step);
      break;
    case StepKind::Push:
      refuse_picture(table, lesson, step, "a push");
      step.push = read_push(table, *lesson.set);
      break;
    case StepKind::Write:
      refuse_picture(table, lesson, step, "lines to be written");
      step.lines = std::make_shared<const LinesToWrite>(read_lines(table, *lesson.set));
      break;
    case StepKind::Threshold:
      step.threshold = read_threshold(table);
      [[fallthrough]];
    case StepKind::Free:
    case StepKind::Cycle:
    case StepKind::Identify:
      step.states = step.kind == StepKind::Identify && read_states(table, lesson);
      step.materials = read_materials(table, step, lesson);
      break;
  }
  if (row.answer == StepAnswer::Comparison && !step.states && lesson.scale != scene::ScaleMode::Common) {
    table.refuse("type", fmt::format("{} needs the lesson's scale = \"common\": on {} every material lets go at the "
                                     "same force of the hand, so that no one can tell them apart",
                                     word_of(step.kind), scene::text_of(lesson.scale).word));
  }
  return step;
}

void read_steps(const TomlTable& top, Lesson& lesson) {
  std::set<std::string, std::less<>> ids;
  bool conditions_used = false;
  for (const TomlTable& table : top.tables("step", kMostSteps)) {
    LessonStep step = read_step(table, lesson);
    if (!ids.insert(step.id).second) table.refuse("id", fmt::format("{} is the id of another step too", step.id));
    conditions_used = conditions_used || step.each_condition;
    lesson.steps.push_back(std::move(step));
  }
  if (top.has("conditions") && !conditions_used) {
    top.refuse("conditions", "are used by no step; give one each_condition = true");
  }
}

Lesson read_lesson(const toml::table& root, const std::string& assets_dir) {
  const TomlTable top(root);
  top.allow_only({"id", "title", "minutes", "materials", "particles", "tapping", "scale", "conditions", "step"});
  Lesson lesson;
  lesson.id = read_id(top, "id");
  lesson.title = read_words(top, "title", kLine);
  lesson.minutes = static_cast<int>(top.whole("minutes", 1, kMostLessonMinutes));
  lesson.materials = top.texts("materials", kMostMaterials);
  if (top.has("particles")) {
    read_particles(top, assets_dir, lesson);
  } else {
    lesson.scale = top.one_of("scale", kLessonScales, &ScaleWord::word).mode;
  }
  if (top.has("tapping")) {
    if (lesson.set) top.refuse("tapping", "is for lessons without particles");
    lesson.tapping = std::make_shared<const curves::TappedHand>(read_tapping(top));
  }
  if (top.has("conditions")) {
    for (const std::string& name : top.texts("conditions", kMostConditions)) {
      lesson.conditions.push_back(top.row_named("conditions", name, kConditions, &ConditionRow::word).condition);
    }
    if (lesson.conditions.size() < 2) top.refuse("conditions", "must be two or more");
  }
  read_steps(top, lesson);
  return lesson;
}

// Appends the bytes of a file, if one is named.
core::Result<void> add_bytes(const std::string& file, std::string& all) {
  if (file.empty()) return {};
  const auto bytes = core::read_file(file);
  if (!bytes) return tl::unexpected(bytes.error());
  all += *bytes;
  return {};
}

}  // namespace

core::Result<Lesson> load_lesson(const std::string& path, const std::string& assets_dir, const std::string& materials) {
  auto lesson = scene::read_toml(kKind, path, [&](const toml::table& root) { return read_lesson(root, assets_dir); });
  if (!lesson) return lesson;
  const auto set = lesson->set ? scene::particle_file(lesson->particles, assets_dir) : core::Result<std::string>();
  if (!set) return tl::unexpected(set.error());
  std::string all;
  for (const std::string& file : {path, *set, materials}) {
    if (auto added = add_bytes(file, all); !added) return tl::unexpected(added.error());
  }
  lesson->digest = fmt::format("{:016x}", core::fnv1a(all));
  return lesson;
}

}  // namespace afm::exhibit
