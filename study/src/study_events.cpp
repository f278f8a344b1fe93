// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/printable.h"
#include "study/study_data.h"
#include "study_table.h"

namespace afm::study {

namespace {

// Columns in the order of a line's fields.
enum EventsColumn {
  Onset,
  Duration,
  Step,
  Type,
  InCondition,
  Practice,
  Number,
  Level,
  Stimulus,
  Response,
  Correct,
  Rt,
  Force,
  Strokes,
  Losses,
  Undos,
  Work,
  LargestForce,
  Aids
};
constexpr std::array<std::string_view, 19> kEventsColumns{
    "onset",  "duration", "step",     "trial_type",    "condition", "practice", "trial",
    "level",  "stimulus", "response", "correct",       "rt",        "force",    "strokes",
    "losses", "undos",    "work",     "largest_force", "aids"};
constexpr std::size_t kNewerColumns = 7;  // number of newer columns, for the force and a push
constexpr double kLongestLesson_s = 1e7;
constexpr double kHighestLevel = 1e3;
constexpr double kMostTrialsOfAStep = 1e6;
constexpr double kFarthestPush_m = 1e-3, kMostPushes = 1e6, kMostPushWork_aj = 1e12, kLargestPushForce_nn = 1e9;
constexpr std::array<std::string_view, 6> kPushEnds{"moved", "target", "pattern", "lost", "line", "threshold"};
constexpr double kMostOverThreshold = 1e3;

// Range of a questionnaire's items, named "sus-1" and so on.
struct ItemRange {
  std::string_view prefix;
  int items;
  double least, most;
};
constexpr std::array kItemRanges{ItemRange{"paper-", 8, 0, 4}, ItemRange{"sus-", 10, 1, 5},
                                 ItemRange{"tlx-", 6, 0, 100}, ItemRange{"ssq-", 16, 0, 3}};

const ItemRange* range_of_item(std::string_view item) {
  for (const ItemRange& each : kItemRanges) {
    if (!item.starts_with(each.prefix)) continue;
    const auto number = parse_number(item.substr(each.prefix.size()), 1, each.items);
    return number && *number == std::floor(*number) ? &each : nullptr;
  }
  return nullptr;
}

// Reads the fields of a line; keeps the first error.
class EventsLine {
 public:
  explicit EventsLine(const std::vector<std::string_view>& fields) : fields_(fields) {}

  const std::string& fault() const { return fault_; }

  StudyTrial read() {
    StudyTrial trial;
    trial.onset_s = required(Onset, 0, kLongestLesson_s);
    trial.duration_s = required(Duration, 0, kLongestLesson_s);
    trial.step = word(Step);
    if (trial.step.empty()) refuse(Step, "a step's id");
    trial.kind = kind();
    trial.condition = word(InCondition);
    trial.practice = required(Practice, 0, 1) == 1.0;
    trial.trial = static_cast<int>(required(Number, 1, kMostTrialsOfAStep));
    trial.level = optional(Level, 0, kHighestLevel);
    trial.stimulus = word(Stimulus);
    trial.response = word(Response);
    trial.rt_s = optional(Rt, 0, kLongestLesson_s);
    const auto force = optional(Force, 0, 1);
    if (force && *force != std::floor(*force)) refuse(Force, "0 or 1");
    if (force) trial.force = *force == 1.0;
    judge(trial);
    return trial;
  }

 private:
  void refuse(EventsColumn column, const std::string& wanted) {
    if (!fault_.empty()) return;
    fault_ = fmt::format("{} \"{}\" is not {}", kEventsColumns[column], core::printable(fields_[column].substr(0, 64)),
                         wanted);
  }

  std::optional<double> optional(EventsColumn column, double least, double most) {
    if (fields_[column].empty()) return std::nullopt;
    const auto value = parse_number(fields_[column], least, most);
    if (!value) refuse(column, fmt::format("a number from {:g} to {:g}", least, most));
    return value;
  }

  // Requires an integer in columns that count.
  double required(EventsColumn column, double least, double most) {
    const auto value = parse_number(fields_[column], least, most);
    const bool counts = column == Practice || column == Number;
    if (value && (!counts || *value == std::floor(*value))) return *value;
    refuse(column, fmt::format("a {}number from {:g} to {:g}", counts ? "whole " : "", least, most));
    return least;
  }

  std::string word(EventsColumn column) {
    if (!fields_[column].empty() && !is_word(fields_[column])) refuse(column, "one word of letters, digits, - and _");
    return std::string(fields_[column]);
  }

  StepKind kind() {
    std::string known;
    for (const StepKindRow& row : kStepKinds) {
      if (fields_[Type] == row.word) return row.kind;
      const bool last = row.kind == kStepKinds.back().kind;
      known += (known.empty() ? "" : last ? " or " : ", ") + std::string(row.word);
    }
    refuse(Type, known);
    return StepKind::Text;
  }

  // Legal responses, and whether one is right, depend on the kind of trial.
  void judge(StudyTrial& trial) {
    constexpr double kLargestForce_n = 1e3;
    switch (trial.kind) {
      case StepKind::Draw:
        trial.value = optional(Response, 0, 1);
        break;
      case StepKind::Cycle:
        trial.value = optional(Response, -kLargestForce_n, kLargestForce_n);
        break;
      case StepKind::Question:
        question(trial);
        break;
      case StepKind::Threshold:
        interval(Stimulus);
        if (!fields_[Response].empty()) interval(Response);
        if (!trial.level) refuse(Level, "the level of a threshold's trial");
        break;
      case StepKind::Identify:
        if (trial.stimulus.empty()) refuse(Stimulus, "the material that was shown");
        break;
      case StepKind::Push:
        push(trial);
        break;
      case StepKind::Write:
        if (!trial.stimulus.empty()) refuse(Stimulus, "empty for lines to be written");
        task(trial);
        break;
      case StepKind::Text:
      case StepKind::Free:
        break;
    }
    if (row_of(trial.kind).answer == StepAnswer::Comparison && !trial.response.empty()) {
      trial.right = trial.stimulus == trial.response;
    }
    const auto said = optional(Correct, 0, 1);
    if (said && *said != std::floor(*said)) refuse(Correct, "0 or 1");
    if (said && trial.right && (*said == 1.0) != *trial.right) refuse(Correct, "what stimulus and response say");
  }

  void question(StudyTrial& trial) {
    const ItemRange* range = range_of_item(trial.stimulus);
    if (range == nullptr) {
      refuse(Stimulus, "an item of a questionnaire: paper-1 to 8, sus-1 to 10, tlx-1 to 6, ssq-1 to 16");
      return;
    }
    trial.value = optional(Response, range->least, range->most);
    if (trial.value && *trial.value != std::floor(*trial.value)) refuse(Response, "a whole number");
  }

  void push(StudyTrial& trial) {
    if (std::find(kPushEnds.begin(), kPushEnds.end(), trial.stimulus) == kPushEnds.end()) {
      refuse(Stimulus, "moved, target, pattern, lost, line or threshold");
    }
    task(trial, trial.stimulus == "threshold" ? kMostOverThreshold : kFarthestPush_m);
  }

  // Reads the columns of a push, or of lines that were written.
  void task(StudyTrial& trial, double most = kFarthestPush_m) {
    trial.value = optional(Response, 0, most);
    trial.strokes = count(Strokes);
    trial.losses = count(Losses);
    trial.undos = count(Undos);
    if (const auto work = optional(Work, -kMostPushWork_aj, kMostPushWork_aj)) trial.work_j = 1e-18 * *work;
    if (const auto force = optional(LargestForce, 0, kLargestPushForce_nn)) trial.largest_force_n = 1e-9 * *force;
    trial.aids = word(Aids);
  }

  std::optional<double> count(EventsColumn column) {
    const auto value = optional(column, 0, kMostPushes);
    if (value && *value != std::floor(*value)) refuse(column, "a whole number");
    return value;
  }

  void interval(EventsColumn column) {
    if (fields_[column] != "first" && fields_[column] != "second") refuse(column, "first or second");
  }

  const std::vector<std::string_view>& fields_;
  std::string fault_;
};

}  // namespace

core::Result<EventsFile> parse_events(std::string_view bytes, const std::string& name) {
  const auto table = parse_tsv(bytes, name, kEventsColumns, kNewerColumns);
  if (!table) return tl::unexpected(table.error());
  EventsFile file{.trials = {}, .cut_line = table->cut_line};
  for (std::size_t row = 0; row < table->lines.size(); ++row) {
    EventsLine line(table->lines[row]);
    file.trials.push_back(line.read());
    if (!line.fault().empty()) return table->bad(row, line.fault());
  }
  return file;
}

}  // namespace afm::study
