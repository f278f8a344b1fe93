// SPDX-License-Identifier: Apache-2.0
#include "data_set_texts.h"

#include <fmt/format.h>

#include <array>
#include <span>

#include "core/json_text.h"
#include "core/version.h"
#include "study/age_band.h"

namespace afm::exhibit {

namespace {

using nlohmann::ordered_json;

struct LevelText {
  const char* level;  // null: no more levels
  const char* meaning;
};
struct ColumnText {
  const char* name;
  const char* description;
  const char* units;  // unit of the values; may be null
  std::array<LevelText, 3> levels{};
};

// Levels with a separate table are added by add_levels().
constexpr std::array kEventTexts{
    ColumnText{"onset", "start of the trial, counted from the start of the lesson", "s"},
    ColumnText{"duration", "duration of the trial", "s"},
    ColumnText{"step", "id of the step in the lesson file", nullptr},
    ColumnText{"trial_type", "type of the step", nullptr},
    ColumnText{"condition", "senses that the step left the participant", nullptr},
    ColumnText{
        "practice", "whether the trial counts", nullptr, {{{"0", "a counted trial"}, {"1", "a practice trial"}}}},
    ColumnText{"trial", "number of the trial within its step, from 1", nullptr},
    ColumnText{"level", "w of a threshold's trial: the stronger F_ad is 1 + w times the weaker one", nullptr},
    ColumnText{"stimulus",
               "identify: material shown, or state of the swing; threshold: cycle that needed more force to let go; "
               "question: item; push: what ended it (moved, target, pattern, lost, line, threshold)",
               nullptr},
    ColumnText{
        "response",
        "identify: material or state answered; threshold: cycle answered; question: number answered (paper 0 to "
        "4, sus 1 "
        "to 5, tlx 0 to 100, ssq 0 to 3); draw: share of right parts; cycle: F_ad in N; push: in m, for target "
        "and pattern the root mean square "
        "distance from the targets; for moved and lost, of the particle from its start; for line, from the line; "
        "for threshold without a unit, the force pressed over the threshold; write: in m, the root "
        "mean square "
        "distance of the groove from the lines",
        nullptr},
    ColumnText{"correct", "whether the answer is right", nullptr, {{{"0", "wrong"}, {"1", "right"}}}},
    ColumnText{
        "rt", "time from the question to the answer; push and write: from the first stroke to the last lift of the tip",
        "s"},
    ColumnText{"force",
               "full force on the hand from snap-in to pull-off, in each cycle of the trial; push and write: whenever "
               "the tip touched a particle or the soft sample; n/a for a trial without either. An attempt that was not "
               "felt as the condition sets "
               "it has no response, and its trial was "
               "repeated",
               nullptr,
               {{{"0", "off, at least for a part of the time"}, {"1", "on"}}}},
    ColumnText{"strokes", "push and write: times that the tip came down and moved a particle or marked the sample",
               nullptr},
    ColumnText{"losses", "push: times that the tip slipped past a particle that it had pushed", nullptr},
    ColumnText{"undos", "push and write: number of strokes taken back", nullptr},
    ColumnText{"work", "push and write: work of the hand on particles or sample", "aJ"},
    ColumnText{"largest_force", "push and write: largest lateral force of particles or sample on the lever", "nN"},
    ColumnText{"aids",
               "push and write: aids used, joined by +",
               nullptr,
               {{{"truth", "the wall showed particles and marks"}, {"undo", "strokes were taken back"}}}}};

constexpr std::array kParticipantTexts{
    ColumnText{"participant_id", "sub- and the participant's code of six letters", nullptr},
    ColumnText{"order", "place in the study from 0; modulo the number of orders it is the row of the Williams design",
               nullptr},
    ColumnText{"age_band", "age in years, as a band", nullptr},
    ColumnText{"comfort",
               "how the participant's newest lesson ended",
               nullptr,
               {{{"finished", "all steps were done"},
                 {"stopped", "ended early"},
                 {"withdrew", "the participant refused, or took the consent back"}}}}};

ordered_json described(std::span<const ColumnText> columns) {
  ordered_json json = ordered_json::object();
  for (const ColumnText& column : columns) {
    ordered_json& entry = json[column.name];
    entry["Description"] = column.description;
    if (column.units != nullptr) entry["Units"] = column.units;
    for (const LevelText& level : column.levels) {
      if (level.level != nullptr) entry["Levels"][level.level] = level.meaning;
    }
  }
  return json;
}

template <class Rows>
void add_levels(ordered_json& json, const char* column, const Rows& rows) {
  for (const auto& row : rows) json[column]["Levels"][std::string(row.word)] = row.meaning;
}

// Name in BIDS for the program that showed the stimuli.
constexpr const char* kPresentation = "StimulusPresentation";
ordered_json presentation() { return {{"SoftwareName", "TouchAFM"}, {"SoftwareVersion", core::kVersion}}; }

constexpr const char* kReadme =
    R"(A study with TouchAFM, a haptic model of an atomic force microscope: people feel force-distance curves, identify
samples by feeling alone, compare pull-off forces and answer questionnaires.

The data set follows the Brain Imaging Data Structure (BIDS). participants.tsv has a row for each code. The folder
sub-CODE/beh has a table of trials for each lesson; the JSON beside a table describes its columns and holds the program,
the lesson, the seed, the device, the scale, the wall and the samples with the sources of their numbers. There are no
names and no clock times. Folders that end in _session hold recordings of the hand in TouchAFM's own format and are no
part of BIDS.

To pool the study: touchafm study FOLDER --out REPORT
)";

}  // namespace

std::vector<RootFile> root_files() {
  ordered_json description{{"Name", "A study with TouchAFM"}, {"BIDSVersion", "1.8.0"}, {"DatasetType", "raw"}};
  description["GeneratedBy"] = ordered_json::array();
  description["GeneratedBy"].push_back(ordered_json::object({{"Name", "TouchAFM"}, {"Version", core::kVersion}}));
  return {{{"dataset_description.json"}, core::json_text(description, 2) + "\n"},
          {{"README", "README.md", "README.rst", "README.txt"}, kReadme},
          {{".bidsignore"}, "*_session/\n"}};
}

std::string task_label(const std::string& lesson) {
  std::string label = lesson;
  std::erase(label, '-');
  return label;
}

ordered_json participants_json() {
  ordered_json json = described(kParticipantTexts);
  add_levels(json, "age_band", study::kAgeBands);
  json[kPresentation] = presentation();  // name of the newest program
  return json;
}

bool describe_anew(const ordered_json& now, ordered_json& old) {
  bool changed = false;
  for (const auto& [column, description] : now.items()) {
    const auto found = old.find(column);
    const bool fits =
        found != old.end() && found->is_object() && (!found->contains("Levels") || (*found)["Levels"].is_object());
    if (fits && (column != kPresentation || *found == description)) continue;
    old[column] = description;
    changed = true;
  }
  return changed;
}

std::string events_json(const Lesson& lesson, const DataSetEntry& entry, std::int64_t day) {
  ordered_json json = described(kEventTexts);
  add_levels(json, "trial_type", kStepKinds);
  add_levels(json, "condition", kConditions);
  ordered_json titles = ordered_json::object();
  for (std::size_t i = 0; i < kLanguages.size(); ++i) titles[std::string(kLanguages[i].word)] = lesson.title.texts[i];
  json["Lesson"] = {{"id", lesson.id},
                    {"title", titles},
                    {"digest", lesson.digest},
                    {"seed", entry.seed},
                    {"program", core::kVersion},
                    {"device", entry.device},
                    {"scale", scene::text_of(lesson.scale).word},
                    {"wall", entry.wall},
                    {"started_day", day}};
  if (!entry.observer.empty()) json["Lesson"]["observer"] = ordered_json::parse(entry.observer);
  json[kPresentation] = presentation();
  if (!entry.samples.empty()) json["Samples"] = ordered_json::parse(entry.samples);
  return core::json_text(json, 2) + "\n";
}

std::string events_header() {
  std::string line;
  for (const ColumnText& column : kEventTexts) line += (line.empty() ? "" : "\t") + std::string(column.name);
  return line + "\n";
}

namespace {

std::string aids_of(const PushFigures& push) {
  std::string aids = push.truth ? "truth" : "";
  if (push.undos > 0) aids += aids.empty() ? "undo" : "+undo";
  return aids.empty() ? kMissingValue : aids;
}

// Columns of a push, each after a tab.
std::string push_cells(const std::optional<PushFigures>& push) {
  if (!push) return fmt::format("\t{0}\t{0}\t{0}\t{0}\t{0}\t{0}", kMissingValue);
  return fmt::format("\t{}\t{}\t{}\t{:.6g}\t{:.6g}\t{}", push->strokes, push->losses, push->undos, 1e18 * push->work_j,
                     1e9 * push->largest_lateral_n, aids_of(*push));
}

}  // namespace

std::string line_of(const TrialRow& row) {
  const auto or_missing = [](const std::string& text) { return text.empty() ? std::string(kMissingValue) : text; };
  const auto yes_or_no = [](const std::optional<bool>& value) { return value ? (*value ? "1" : "0") : kMissingValue; };
  return fmt::format("{:.3f}\t{:.3f}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}{}\n", row.onset_s, row.duration_s,
                     row.step, word_of(row.kind), row.condition ? word_of(*row.condition) : kMissingValue,
                     row.practice ? 1 : 0, row.trial, row.level ? fmt::format("{:.6g}", *row.level) : kMissingValue,
                     or_missing(row.stimulus), or_missing(row.response), yes_or_no(row.correct),
                     row.rt_s ? fmt::format("{:.3f}", *row.rt_s) : kMissingValue, yes_or_no(row.force),
                     push_cells(row.push));
}

}  // namespace afm::exhibit
