// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/lesson_file.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>
#include <utility>

#include "core/enumerators.h"
#include "core/fnv1a.h"
#include "core/whole_file.h"
#include "exhibit/lesson/questionnaire.h"
#include "physics/quantity_text.h"
#include "scene/config/toml_file.h"

namespace afm::exhibit {

namespace {

constexpr const char* kKind = "lesson file";
constexpr std::size_t kMostSteps = 100, kMostIdLetters = 40, kMostConditions = 4;
constexpr int kMostTrials = 200, kMostPractice = 20;
constexpr double kLongestHintS = 600;

// A table of the file. Its errors name key and line.
class LessonTable {
 public:
  LessonTable(const toml::table& table, std::string section) : table_(table), section_(std::move(section)) {}

  void allow_only(std::initializer_list<std::string_view> keys) const {
    for (const auto& [key, node] : table_) {
      if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
      refuse(key.str(), fmt::format("unknown key; known are {}", fmt::join(keys, ", ")));
    }
  }

  bool has(std::string_view key) const { return table_.contains(key); }

  [[noreturn]] void refuse(std::string_view key, std::string what) const {
    const toml::node* node = table_.get(key);
    throw scene::Fault{node != nullptr ? node->source() : table_.source(),
                       section_.empty() ? std::string(key) : section_ + "." + std::string(key), std::move(what)};
  }

  std::string text(std::string_view key, std::size_t limit) const {
    const auto value = required(key).value_exact<std::string>();
    if (!value || value->empty() || value->size() > limit) {
      refuse(key, fmt::format("must be text of 1 to {} bytes in quotes", limit));
    }
    return *value;
  }

  // Part of file or column names.
  std::string id(std::string_view key) const {
    const std::string value = text(key, kMostIdLetters);
    const bool plain = std::all_of(value.begin(), value.end(),
                                   [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-'; });
    if (!plain || value.front() == '-') refuse(key, "must be lower-case letters, digits and dashes");
    return value;
  }

  // A text for each language.
  LessonText words(std::string_view key, std::size_t limit) const {
    const toml::table* table = required(key).as_table();
    if (table == nullptr) {
      std::string texts;
      for (const LanguageRow& row : kLanguages)
        texts += fmt::format("{}{} = \"...\"", texts.empty() ? "" : ", ", row.word);
      refuse(key, fmt::format("must be {{ {} }}", texts));
    }
    const LessonTable languages(*table, section_.empty() ? std::string(key) : section_ + "." + std::string(key));
    for (const auto& [language, node] : *table) {
      std::vector<std::string_view> known;
      known.reserve(kLanguages.size());
      for (const LanguageRow& row : kLanguages) known.push_back(row.word);
      if (std::find(known.begin(), known.end(), language.str()) == known.end()) {
        languages.refuse(language.str(), fmt::format("unknown language; known are {}", fmt::join(known, ", ")));
      }
    }
    LessonText words;
    for (std::size_t i = 0; i < kLanguages.size(); ++i) words.texts[i] = languages.text(kLanguages[i].word, limit);
    return words;
  }

  int whole(std::string_view key, int least, int most, int fallback) const {
    if (!has(key)) return fallback;
    const auto value = required(key).value_exact<std::int64_t>();
    if (!value || *value < least || *value > most) {
      refuse(key, fmt::format("must be a whole number from {} to {}", least, most));
    }
    return static_cast<int>(*value);
  }

  double number(std::string_view key, double least, double most, double fallback) const {
    if (!has(key)) return fallback;
    const auto value = required(key).value<double>();
    if (!value || !(*value >= least) || !(*value <= most)) {
      refuse(key, fmt::format("must be a number from {:g} to {:g}", least, most));
    }
    return *value;
  }

  double time_s(std::string_view key, double most_s) const {
    const auto parsed = physics::parse_quantity(text(key, kMostIdLetters), physics::kTimeUnits);
    if (!parsed.value) refuse(key, parsed.error);
    if (!(parsed.value->si >= 0.0) || parsed.value->si > most_s) {
      refuse(key, fmt::format("must lie between 0 s and {:g} s", most_s));
    }
    return parsed.value->si;
  }

  bool flag(std::string_view key) const {
    if (!has(key)) return false;
    const auto value = required(key).value_exact<bool>();
    if (!value) refuse(key, "must be true or false");
    return *value;
  }

  std::vector<std::string> names(std::string_view key, std::size_t most) const {
    const toml::array* array = required(key).as_array();
    if (array == nullptr || array->empty() || array->size() > most) {
      refuse(key, fmt::format("must be a list of 1 to {} texts", most));
    }
    std::vector<std::string> names;
    for (const toml::node& node : *array) {
      const auto name = node.value_exact<std::string>();
      if (!name || name->empty() || std::find(names.begin(), names.end(), *name) != names.end()) {
        refuse(key, "must be a list of texts, each of them once");
      }
      names.push_back(*name);
    }
    return names;
  }

  // The row of `table` with the name `text`.
  template <class Table, class Row>
  const Row& one_of(std::string_view key, const Table& table, std::string_view Row::* name) const {
    const std::string value = text(key, kMostIdLetters);
    return row_named(key, value, table, name);
  }
  template <class Table, class Row>
  const Row& row_named(std::string_view key, std::string_view value, const Table& table,
                       std::string_view Row::* name) const {
    std::string known;
    for (const Row& row : table) {
      if (row.*name == value) return row;
      known += (known.empty() ? "" : ", ") + std::string(row.*name);
    }
    refuse(key, fmt::format("{} is unknown; known are {}", value, known));
  }

  const toml::node& required(std::string_view key) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr) refuse(key, "is missing");
    return *node;
  }

 private:
  const toml::table& table_;
  std::string section_;
};

struct ScaleWord {
  scene::ScaleMode mode;
  std::string_view word;
};
// All scales except that of atoms, on which two materials cannot be compared by hand.
constexpr auto kLessonScales = [] {
  std::array<ScaleWord, scene::kScaleModes.size() - 1> rows{};
  std::size_t count = 0;
  for (const scene::ScaleModeText& row : scene::kScaleModes) {
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

ThresholdPlan read_threshold(const LessonTable& table) {
  ThresholdPlan plan;
  plan.rule = table.one_of("staircase", kRules, &RuleWord::word).rule;
  plan.distance = table.one_of("distance", kCues, &CueWord::word).cue;
  if (plan.distance == DistanceCue::Roved) {
    table.required("rove");
    plan.rove = table.number("rove", 0.05, 1.0, 0.0);
  } else if (table.has("rove")) {
    table.refuse("rove", "is for distance = \"roved\" alone");
  }
  plan.least = table.number("least", 1e-3, 1.0, plan.least);
  plan.most = table.number("most", 1e-2, 5.0, plan.most);
  plan.start = table.number("start", 1e-3, 5.0, plan.start);
  plan.step = table.number("step", 1.01, 4.0, plan.step);
  if (!(plan.least < plan.most)) table.refuse("least", "must be below most");
  if (plan.start < plan.least || plan.start > plan.most) table.refuse("start", "must lie between least and most");
  return plan;
}

// Indices of a step's materials in the lesson's list.
std::vector<std::size_t> read_materials(const LessonTable& table, const LessonStep& step, const Lesson& lesson) {
  std::vector<std::size_t> places;
  const auto place_of = [&](std::string_view key, const std::string& name) {
    const auto found = std::find(lesson.materials.begin(), lesson.materials.end(), name);
    if (found == lesson.materials.end()) {
      table.refuse(key,
                   fmt::format("{} is none of the lesson's materials: {}", name, fmt::join(lesson.materials, ", ")));
    }
    places.push_back(static_cast<std::size_t>(found - lesson.materials.begin()));
  };
  if (step.kind == StepKind::Cycle || step.kind == StepKind::Threshold) {
    place_of("material", table.text("material", kMostIdLetters));
    return places;
  }
  if (table.has("materials")) {
    for (const std::string& name : table.names("materials", kMostMaterials)) place_of("materials", name);
  } else {
    for (const std::string& name : lesson.materials) place_of("materials", name);
  }
  if (step.kind == StepKind::Identify && places.size() < 2) {
    table.refuse(table.has("materials") ? "materials" : "type", "needs two materials or more to tell apart");
  }
  return places;
}

void read_questionnaire(const LessonTable& table, LessonStep& step) {
  const QuestionnaireRow& row = table.one_of("questionnaire", kQuestionnaires, &QuestionnaireRow::word);
  step.questionnaire = row.questionnaire;
  if (row.questionnaire != Questionnaire::Ssq) {
    if (table.has("when")) table.refuse("when", "is for the questionnaire ssq alone");
    return;
  }
  const std::string ending = "-" + std::string(table.one_of("when", kMoments, &MomentWord::word).word);
  if (!step.id.ends_with(ending)) table.refuse("id", fmt::format("of this step must end in {}", ending));
}

// Allows the keys of each type in addition to those of all steps.
void allow_keys(const LessonTable& table, StepKind kind) {
  switch (kind) {
    case StepKind::Text:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition"});
    case StepKind::Free:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "materials", "cycles"});
    case StepKind::Cycle:
      return table.allow_only(
          {"id", "type", "words", "hint", "hint_after", "each_condition", "material", "trials", "practice"});
    case StepKind::Identify:
      return table.allow_only(
          {"id", "type", "words", "hint", "hint_after", "each_condition", "materials", "trials", "practice"});
    case StepKind::Threshold:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "material", "trials",
                               "practice", "staircase", "distance", "rove", "start", "least", "most", "step"});
    case StepKind::Draw:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "trials", "practice"});
    case StepKind::Question:
      return table.allow_only({"id", "type", "words", "hint", "hint_after", "each_condition", "questionnaire", "when"});
  }
}

void read_common(const LessonTable& table, const Lesson& lesson, LessonStep& step) {
  step.id = table.id("id");
  step.words = table.words("words", kParagraph);
  if (table.has("hint")) step.hint = table.words("hint", kParagraph);
  if (table.has("hint") != table.has("hint_after")) {
    table.refuse(table.has("hint") ? "hint" : "hint_after", "needs both hint and hint_after");
  }
  if (table.has("hint_after")) step.hint_after_s = table.time_s("hint_after", kLongestHintS);
  step.each_condition = table.flag("each_condition");
  if (step.each_condition && lesson.conditions.empty()) {
    table.refuse("each_condition", "needs the lesson's conditions");
  }
}

LessonStep read_step(const LessonTable& table, const Lesson& lesson) {
  LessonStep step;
  step.kind = table.one_of("type", kStepKinds, &study::StepKindRow::word).kind;
  allow_keys(table, step.kind);
  read_common(table, lesson, step);
  step.trials =
      step.kind == StepKind::Free ? table.whole("cycles", 1, kMostTrials, 1) : table.whole("trials", 1, kMostTrials, 1);
  step.practice = table.whole("practice", 0, kMostPractice, 0);
  switch (step.kind) {
    case StepKind::Text:
    case StepKind::Draw:
      break;
    case StepKind::Question:
      read_questionnaire(table, step);
      break;
    case StepKind::Threshold:
      step.threshold = read_threshold(table);
      [[fallthrough]];
    case StepKind::Free:
    case StepKind::Cycle:
    case StepKind::Identify:
      step.materials = read_materials(table, step, lesson);
      break;
  }
  if (row_of(step.kind).compares_forces && lesson.scale != scene::ScaleMode::Common) {
    table.refuse("type", fmt::format("{} needs the lesson's scale = \"common\": on {} every material lets go at the "
                                     "same force of the hand, so that no one can tell them apart",
                                     word_of(step.kind), scene::text_of(lesson.scale).word));
  }
  return step;
}

void read_steps(const toml::table& root, const LessonTable& top, Lesson& lesson) {
  const toml::array* steps = top.required("step").as_array();
  if (steps == nullptr || steps->empty() || steps->size() > kMostSteps || !steps->is_array_of_tables()) {
    top.refuse("step", fmt::format("must be 1 to {} tables [[step]]", kMostSteps));
  }
  std::set<std::string, std::less<>> ids;
  bool conditions_used = false;
  for (const toml::node& node : *steps) {
    const LessonTable table(*node.as_table(), "step");
    LessonStep step = read_step(table, lesson);
    if (!ids.insert(step.id).second) table.refuse("id", fmt::format("{} is the id of another step too", step.id));
    conditions_used = conditions_used || step.each_condition;
    lesson.steps.push_back(std::move(step));
  }
  if (root.contains("conditions") && !conditions_used) {
    top.refuse("conditions", "are used by no step; give one each_condition = true");
  }
}

Lesson read_lesson(const toml::table& root) {
  const LessonTable top(root, "");
  top.allow_only({"id", "title", "minutes", "materials", "scale", "conditions", "step"});
  Lesson lesson;
  lesson.id = top.id("id");
  lesson.title = top.words("title", kLine);
  top.required("minutes");
  lesson.minutes = top.whole("minutes", 1, kMostLessonMinutes, 0);
  lesson.materials = top.names("materials", kMostMaterials);
  lesson.scale = top.one_of("scale", kLessonScales, &ScaleWord::word).mode;
  if (top.has("conditions")) {
    for (const std::string& name : top.names("conditions", kMostConditions)) {
      lesson.conditions.push_back(top.row_named("conditions", name, kConditions, &ConditionRow::word).condition);
    }
    if (lesson.conditions.size() < 2) top.refuse("conditions", "must be two or more");
  }
  read_steps(root, top, lesson);
  return lesson;
}

}  // namespace

core::Result<Lesson> load_lesson(const std::string& path) {
  auto lesson = scene::read_toml(kKind, path, [](const toml::table& root) { return read_lesson(root); });
  if (!lesson) return lesson;
  const auto bytes = core::read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  lesson->digest = fmt::format("{:016x}", core::fnv1a(*bytes));
  return lesson;
}

}  // namespace afm::exhibit
