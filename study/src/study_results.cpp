// SPDX-License-Identifier: Apache-2.0
#include "study/study_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <set>
#include <span>
#include <string_view>
#include <utility>

#include "study_groups.h"

namespace afm::study {

namespace {

// Common and differing properties of a lesson's visits.
struct LessonVisits {
  std::vector<std::pair<std::string, const LessonVisit*>> visits;  // id and visit of each person
};

struct FactRow {
  const char* name;
  std::string LessonFacts::* value;
};
constexpr std::array kFactRows{FactRow{"lesson's digest", &LessonFacts::digest},
                               FactRow{"program", &LessonFacts::program}, FactRow{"device", &LessonFacts::device},
                               FactRow{"scale", &LessonFacts::scale}, FactRow{"wall", &LessonFacts::wall}};

std::vector<std::string> facts_of(const LessonVisits& lesson) {
  std::vector<std::string> lines;
  for (const FactRow& row : kFactRows) {
    std::set<std::string> values;
    for (const auto& [id, visit] : lesson.visits) {
      if (const std::string& value = visit->facts.*row.value; !value.empty()) values.insert(value);
    }
    if (values.empty()) continue;
    lines.push_back(fmt::format("{}: {}{}", row.name, fmt::join(values, ", "),
                                values.size() > 1 ? " (it is not the same for all)" : ""));
  }
  return lines;
}

// Mean of a number over those of a person's trials that have it.
using NumberOf = std::function<std::optional<double>(const StudyTrial&)>;

void add_means(const TrialGroups& groups, const Measure& like, const std::string& title, const NumberOf& number_of,
               std::vector<Measure>& measures) {
  std::map<std::string, Measure> by_step;
  for (const auto& [where, people] : groups) {
    for (const auto& [id, trials] : people) {
      std::vector<double> numbers;
      for (const StudyTrial* trial : trials) {
        if (const auto number = number_of(*trial)) numbers.push_back(*number);
      }
      if (numbers.empty()) continue;
      Measure& measure = by_step.try_emplace(where.step, like).first->second;
      measure.key = like.key + "." + where.step;
      measure.title = fmt::format("{}, {}", where.step, title);
      measure.values[where.condition][id] = summary_of(numbers).mean;
    }
  }
  for (auto& [step, measure] : by_step) measures.push_back(std::move(measure));
}

// Weber fraction and bias of each person.
void add_thresholds(const std::vector<ThresholdResult>& results, std::vector<Measure>& measures) {
  std::map<std::string, std::pair<Measure, Measure>> by_step;
  for (const ThresholdResult& result : results) {
    auto& [weber, bias] = by_step[result.step];
    weber.key = "weber_fraction." + result.step;
    weber.title = result.step + ", Weber fraction";
    weber.decimals = 3;
    weber.logarithmic = true;
    bias.key = "bias." + result.step;
    bias.title = result.step + ", bias towards the first";
    for (const ThresholdResult::Person& person : result.people) {
      if (!(person.fit.weber_fraction.value > 0.0)) continue;
      weber.values[result.condition][person.id] = person.fit.weber_fraction.value;
      bias.values[result.condition][person.id] = person.fit.bias.value;
    }
  }
  for (auto& [step, pair] : by_step) {
    if (pair.first.values.empty()) continue;
    measures.push_back(std::move(pair.first));
    measures.push_back(std::move(pair.second));
  }
}

// Steps named NAME-before and NAME-after are compared like two conditions of NAME.
TrialGroups before_and_after(const TrialGroups& steps) {
  TrialGroups groups;
  for (const auto& [where, people] : steps) {
    StepAndCondition to = where;
    for (const std::string time : {"before", "after"}) {
      if (!where.condition.empty() || !where.step.ends_with("-" + time)) continue;
      to = {where.step.substr(0, where.step.size() - time.size() - 1), time};
    }
    groups[to] = people;
  }
  return groups;
}

bool has_aid(const StudyTrial& trial, std::string_view aid) {
  return fmt::format("+{}+", trial.aids).find(fmt::format("+{}+", aid)) != std::string::npos;
}

std::optional<double> value_of(const StudyTrial& trial) { return trial.value; }

struct TaskRow {
  const char* key;
  const char* title;
  const char* unit;
  double per_si;
  Interval scale;
  NumberOf number;
};

// Adds the numbers of a task: a push, or lines that were written.
void add_task(const TrialGroups& steps, std::span<const TaskRow> rows, LessonResults& results) {
  const TrialGroups groups = before_and_after(steps);
  for (const TaskRow& row : rows) {
    Measure like;
    like.key = row.key, like.unit = row.unit, like.per_si = row.per_si, like.scale = row.scale;
    add_means(groups, like, row.title, row.number, results.measures);
  }
}

constexpr Interval kAnyNumber{-kUnbounded, kUnbounded};
std::optional<double> strokes_of(const StudyTrial& trial) { return trial.strokes; }
std::optional<double> undos_of(const StudyTrial& trial) { return trial.undos; }
std::optional<double> work_of(const StudyTrial& trial) { return trial.work_j; }
std::optional<double> largest_force_of(const StudyTrial& trial) { return trial.largest_force_n; }
std::optional<double> seconds_of(const StudyTrial& trial) { return trial.rt_s; }

void add_written(const TrialGroups& lines, LessonResults& results) {
  add_task(lines,
           std::array{TaskRow{"off_m", "distance from the lines", "nm", 1e9, kNotNegative, value_of},
                      TaskRow{"writing_time_s", "time of writing", "s", 1.0, kNotNegative, seconds_of},
                      TaskRow{"strokes", "strokes", "", 1.0, kNotNegative, strokes_of},
                      TaskRow{"undos", "strokes taken back", "", 1.0, kNotNegative, undos_of},
                      TaskRow{"work_J", "work on the sample", "aJ", 1e18, kAnyNumber, work_of},
                      TaskRow{"largest_force_N", "largest lateral force", "nN", 1e9, kNotNegative, largest_force_of}},
           results);
}

void add_pushes(const TrialGroups& pushes, LessonResults& results) {
  const auto only = [](std::initializer_list<std::string_view> ends) {
    return [ends = std::vector<std::string_view>(ends)](const StudyTrial& trial) {
      return std::find(ends.begin(), ends.end(), trial.stimulus) != ends.end() ? trial.value : std::nullopt;
    };
  };
  add_task(
      pushes,
      std::array{
          TaskRow{"distance_m", "distance from the targets", "nm", 1e9, kNotNegative, only({"target", "pattern"})},
          TaskRow{"aside_m", "distance from the line", "nm", 1e9, kNotNegative, only({"line"})},
          TaskRow{"over_threshold", "force pressed over the threshold", "", 1.0, kNotNegative, only({"threshold"})},
          TaskRow{"way_m", "way of the particle", "nm", 1e9, kNotNegative, only({"moved", "lost"})},
          TaskRow{"push_time_s", "time of the push", "s", 1.0, kNotNegative, seconds_of},
          TaskRow{"strokes", "pushes", "", 1.0, kNotNegative, strokes_of},
          TaskRow{"losses", "slipped past", "", 1.0, kNotNegative, [](const auto& trial) { return trial.losses; }},
          TaskRow{"undos", "pushes taken back", "", 1.0, kNotNegative, undos_of},
          TaskRow{"work_J", "work on the particles", "aJ", 1e18, kAnyNumber, work_of},
          TaskRow{"largest_force_N", "largest lateral force", "nN", 1e9, kNotNegative, largest_force_of}},
      results);
  for (const auto& [where, people] : pushes) {
    for (const auto& [id, trials] : people) {
      for (const StudyTrial* trial : trials) {
        ++results.pushes.counted;
        if (has_aid(*trial, "truth")) ++results.pushes.with_truth;
        if (has_aid(*trial, "undo")) ++results.pushes.with_undo;
      }
    }
  }
}

bool has_answer(const StudyTrial& trial) {
  switch (row_of(trial.kind).answer) {
    case StepAnswer::Comparison:
      return trial.right.has_value();
    case StepAnswer::Number:
      return trial.value.has_value();
    case StepAnswer::None:
      break;
  }
  return true;
}

// Tests of one list of a report.
template <class Row>
void correct_side_by_side(std::vector<Row>& rows, TestResult Row::* test) {
  std::vector<TestResult*> tests;
  tests.reserve(rows.size());
  for (Row& row : rows) tests.push_back(&(row.*test));
  correct_by_holm(tests);
}

Measure measure_of(std::string key, std::string unit, double per_si, const Interval& scale) {
  Measure like;
  like.key = std::move(key), like.unit = std::move(unit), like.per_si = per_si, like.scale = scale;
  return like;
}

void add_answer_times(const TrialGroups& groups, LessonResults& results) {
  add_means(
      groups, measure_of("answer_time_s", "s", 1.0, kNotNegative), "time to answer",
      [](const StudyTrial& trial) { return trial.rt_s; }, results.measures);
}

void add_identified(const TrialGroups& groups, LessonResults& results) {
  const auto materials = materials_of_steps(groups);
  for (const auto& [where, trials] : groups) {
    results.identify.push_back(identify_result(where, trials, materials.at(where.step)));
  }
  results.learning = learning_results(groups);
  add_means(
      groups, measure_of("right", "", 1.0, kShares), "share right",
      [](const StudyTrial& trial) { return std::optional(*trial.right ? 1.0 : 0.0); }, results.measures);
  add_answer_times(groups, results);
}

void add_compared(const TrialGroups& groups, LessonResults& results) {
  for (const auto& [where, trials] : groups) results.thresholds.push_back(threshold_result(where, trials));
  add_thresholds(results.thresholds, results.measures);
  add_answer_times(groups, results);
}

void add_drawings(const TrialGroups& groups, LessonResults& results) {
  add_means(groups, measure_of("drawing", "", 1.0, kShares), "score of the drawing", value_of, results.measures);
}

void add_felt(const TrialGroups& groups, LessonResults& results) {
  add_means(groups, measure_of("pull_off_felt_N", "nN", 1e9, kNotNegative), "pull-off force felt", value_of,
            results.measures);
}

void add_questions(const TrialGroups& groups, LessonResults& results) {
  std::map<std::string, std::vector<const StudyTrial*>> questions;
  for (const auto& [where, people] : groups) {
    for (const auto& [id, trials] : people) questions[id].insert(questions[id].end(), trials.begin(), trials.end());
  }
  for (auto& [id, trials] : questions) {
    std::stable_sort(trials.begin(), trials.end(),
                     [](const StudyTrial* a, const StudyTrial* b) { return a->onset_s < b->onset_s; });
  }
  add_questionnaires(questions, results);
}

// Measures of each type of step that has an answer, in the order of the report.
struct MeasuresRow {
  StepKind kind;
  void (*add)(const TrialGroups& groups, LessonResults& results);
};
constexpr std::array kMeasures{
    MeasuresRow{StepKind::Identify, add_identified}, MeasuresRow{StepKind::Threshold, add_compared},
    MeasuresRow{StepKind::Draw, add_drawings},       MeasuresRow{StepKind::Cycle, add_felt},
    MeasuresRow{StepKind::Push, add_pushes},         MeasuresRow{StepKind::Write, add_written},
    MeasuresRow{StepKind::Question, add_questions}};
constexpr bool is_measured(const StepKindRow& step) {
  return std::any_of(kMeasures.begin(), kMeasures.end(), [&](const MeasuresRow& row) { return row.kind == step.kind; });
}
static_assert(std::all_of(kStepKinds.begin(), kStepKinds.end(),
                          [](const StepKindRow& step) {
                            return is_measured(step) == (step.answer != StepAnswer::None);
                          }),
              "every type of step with an answer needs a row in kMeasures");

using GroupsByKind = std::map<StepKind, TrialGroups>;

GroupsByKind counted_trials(const LessonVisits& lesson, LessonResults& results) {
  GroupsByKind groups;
  for (const auto& [id, visit] : lesson.visits) {
    for (const StudyTrial& trial : visit->trials) {
      if (trial.practice) {
        ++results.practice;
      } else if (!trial.felt_as_set().value_or(true)) {
        ++results.not_felt;
      } else if (!has_answer(trial)) {
        ++results.unanswered;
      } else {
        ++results.counted;
        if (row_of(trial.kind).has_cycles && !trial.force) ++results.force_unknown;
        groups[trial.kind][{trial.step, trial.condition}][id].push_back(&trial);
      }
    }
  }
  return groups;
}

LessonResults lesson_results(const std::string& task, const LessonVisits& lesson) {
  LessonResults results;
  results.task = task;
  results.title = lesson.visits.front().second->facts.title;
  results.facts = facts_of(lesson);
  results.people = lesson.visits.size();
  results.simulated = static_cast<std::size_t>(std::count_if(
      lesson.visits.begin(), lesson.visits.end(), [](const auto& visit) { return visit.second->facts.simulated; }));
  GroupsByKind groups = counted_trials(lesson, results);
  for (const MeasuresRow& row : kMeasures) row.add(groups[row.kind], results);
  for (const Measure& measure : results.measures) {
    const auto compared = compared_conditions(measure);
    results.comparisons.insert(results.comparisons.end(), compared.begin(), compared.end());
  }
  correct_side_by_side(results.comparisons, &ConditionComparison::test);
  correct_side_by_side(results.identify, &IdentifyResult::against_chance);
  correct_side_by_side(results.learning, &LearningResult::change);
  correct_side_by_side(results.learning, &LearningResult::single_trials);
  correct_side_by_side(results.ssq, &SsqResult::change);
  return results;
}

// The newest answers of each person in any lesson.
template <std::size_t items>
std::map<std::string, std::array<std::optional<double>, items>> newest_answers(const StudyData& data,
                                                                               std::string_view questionnaire) {
  std::map<std::string, std::array<std::optional<double>, items>> answers;
  for (const StudyData::Member& member : data.members) {
    for (const LessonVisit& visit : member.visits) {
      for (const StudyTrial& trial : visit.trials) {
        const auto item = item_of(trial, questionnaire);
        if (item && !trial.practice && trial.value) answers[member.person.id][*item] = trial.value;
      }
    }
  }
  return answers;
}

template <std::size_t items>
double alpha_of(const std::map<std::string, std::array<std::optional<double>, items>>& answers, bool alternating) {
  std::vector<std::vector<double>> people;
  for (const auto& [id, given] : answers) {
    if (!std::all_of(given.begin(), given.end(), [](const auto& answer) { return answer.has_value(); })) continue;
    std::vector<double>& row = people.emplace_back();
    // every second item of the SUS is negative
    for (std::size_t i = 0; i < items; ++i) row.push_back(alternating && i % 2 == 1 ? -*given[i] : *given[i]);
  }
  return cronbach_alpha(people);
}

constexpr Interval kAnswerScale{0.0, kSurveyHighest};  // scale of the paper's questions

void add_survey(const StudyData& data, StudyResults& results) {
  const auto answers = newest_answers<8>(data, "paper-");
  results.sus_alpha = alpha_of(newest_answers<10>(data, "sus-"), true);
  if (answers.empty()) return;
  results.survey_alpha = alpha_of(answers, false);
  for (std::size_t i = 0; i < survey_questions().size(); ++i) {
    std::vector<double> list;
    for (const auto& [id, given] : answers) {
      if (given[i]) list.push_back(*given[i]);
    }
    const Summary summary = summary_of(list);
    results.survey.push_back({summary, t_interval(summary).within(kAnswerScale),
                              as_result("Welch t", welch_test(summary, printed_summary(survey_questions()[i])), "d")});
  }
  correct_side_by_side(results.survey, &SurveyResult::against_paper);
  std::vector<double> differences;
  for (const auto& [id, given] : answers) {
    if (given[kHapticsQuestion] && given[kGraphicsQuestion]) {
      differences.push_back(*given[kHapticsQuestion] - *given[kGraphicsQuestion]);
    }
  }
  results.haptics_against_graphics = {as_result("paired t", paired_test(differences), "d_z"), sign_test(differences)};
  results.haptics_against_graphics[1].effect_name = "share that found haptics more helpful, of those who differ";
}

}  // namespace

StudyResults study_results(const StudyData& data) {
  StudyResults results;
  results.listed = data.listed;
  results.people = data.members.size();
  results.left_out = data.left_out;
  results.remarks = data.remarks;
  for (const StudyData::Member& member : data.members) {
    if (!member.person.age_band.empty()) ++results.ages[member.person.age_band];
  }
  std::map<std::string, LessonVisits> lessons;
  for (const StudyData::Member& member : data.members) {
    for (const LessonVisit& visit : member.visits) lessons[visit.task].visits.emplace_back(member.person.id, &visit);
  }
  for (const auto& [task, lesson] : lessons) results.lessons.push_back(lesson_results(task, lesson));
  add_survey(data, results);
  return results;
}

}  // namespace afm::study
