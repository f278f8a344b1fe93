// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/questionnaires.h"
#include "study_groups.h"
#include "study_table.h"

namespace afm::study {

namespace {

// All answers of a person; empty if one is missing.
template <std::size_t items>
std::optional<std::array<double, items>> complete(const std::array<std::optional<double>, items>& answers) {
  std::array<double, items> values{};
  for (std::size_t i = 0; i < items; ++i) {
    if (!answers[i]) return std::nullopt;
    values[i] = *answers[i];
  }
  return values;
}

// The newest answers by person, or first by the result of `group` for a trial and then by person.
template <std::size_t items, class Group>
Answers<items> gathered(const std::map<std::string, std::vector<const StudyTrial*>>& questions,
                        std::string_view questionnaire, const Group& group) {
  Answers<items> answers;
  for (const auto& [id, trials] : questions) {
    for (const StudyTrial* trial : trials) {
      if (const auto item = item_of(*trial, questionnaire)) answers[group(*trial)][id][*item] = trial->value;
    }
  }
  return answers;
}

std::string condition_of(const StudyTrial& trial) { return trial.condition; }

// Word for the time of a trial: "before", "after", or empty.
std::string time_of(const StudyTrial& trial) {
  for (const char* time : {"before", "after"}) {
    if (trial.step.ends_with(std::string("-") + time)) return time;
  }
  return {};
}

template <std::size_t items, class Score>
void add_measure(const Answers<items>& answers, Measure measure, const Score& score, LessonResults& results) {
  for (const auto& [condition, people] : answers) {
    for (const auto& [id, given] : people) {
      if (const auto values = complete(given)) {
        measure.values[condition][id] = score(*values);
      } else {
        results.left_out.push_back(
            fmt::format("{}{}: {} is not complete", id, condition.empty() ? "" : ", " + condition, measure.title));
      }
    }
  }
  if (!measure.values.empty()) results.measures.push_back(std::move(measure));
}

constexpr Interval kOf100{0.0, 100.0};

struct SsqScale {
  const char* name;
  double SsqScores::* score;
};
constexpr std::array kSsqScales{SsqScale{"nausea", &SsqScores::nausea}, SsqScale{"oculomotor", &SsqScores::oculomotor},
                                SsqScale{"disorientation", &SsqScores::disorientation},
                                SsqScale{"total", &SsqScores::total}};

void add_ssq(const Answers<16>& answers, LessonResults& results) {
  std::map<std::string, std::map<std::string, SsqScores>> scores;
  std::map<std::string, bool> stopped;
  for (const auto& [time, people] : answers) {
    for (const auto& [id, given] : people) {
      const auto values = complete(given);
      if (!values) {
        results.left_out.push_back(fmt::format("{}: SSQ {} is not complete", id, time));
        continue;
      }
      scores[time][id] = ssq_scores(*values);
      stopped[id] = stopped[id] || ssq_says_stop(*values);
    }
  }
  results.ssq_stops = static_cast<std::size_t>(
      std::count_if(stopped.begin(), stopped.end(), [](const auto& person) { return person.second; }));
  for (const SsqScale& scale : kSsqScales) {
    std::vector<double> before, after, differences;
    for (const auto& [id, first] : scores["before"]) {
      const auto second = scores["after"].find(id);
      if (second == scores["after"].end()) continue;
      before.push_back(first.*scale.score);
      after.push_back(second->second.*scale.score);
      differences.push_back(after.back() - before.back());
    }
    if (before.empty()) return;
    results.ssq.push_back({scale.name, mean_estimate(before, kNotNegative), mean_estimate(after, kNotNegative),
                           as_result("paired t", paired_test(differences), "d_z")});
  }
}

std::vector<double> values_of(const std::map<std::string, double>& people) {
  std::vector<double> values;
  values.reserve(people.size());
  for (const auto& [id, value] : people) values.push_back(value);
  return values;
}

double on_scale(const Measure& measure, double value) { return measure.logarithmic ? std::log(value) : value; }

TestResult comparison_of(const Measure& measure, const std::map<std::string, double>& a,
                         const std::map<std::string, double>& b) {
  std::vector<double> differences;
  for (const auto& [id, value] : a) {
    const auto other = b.find(id);
    if (other != b.end()) differences.push_back(on_scale(measure, value) - on_scale(measure, other->second));
  }
  const std::string of = measure.logarithmic ? " of logarithms" : "";
  if (differences.size() >= 2) return as_result("paired t" + of, paired_test(differences), "d_z");
  std::vector<double> left, right;
  for (const auto& [id, value] : a) left.push_back(on_scale(measure, value));
  for (const auto& [id, value] : b) right.push_back(on_scale(measure, value));
  return as_result("Welch t" + of, welch_test(summary_of(left), summary_of(right)), "d");
}

}  // namespace

std::optional<std::size_t> item_of(const StudyTrial& trial, std::string_view questionnaire) {
  if (trial.kind != StepKind::Question || !trial.stimulus.starts_with(questionnaire)) return std::nullopt;
  const auto number = parse_number(std::string_view(trial.stimulus).substr(questionnaire.size()), 1, 100);
  return number ? std::optional(static_cast<std::size_t>(*number) - 1) : std::nullopt;
}

void add_questionnaires(const std::map<std::string, std::vector<const StudyTrial*>>& questions,
                        LessonResults& results) {
  add_measure(
      gathered<10>(questions, "sus-", condition_of),
      {.key = "sus", .title = "SUS", .unit = "of 100", .per_si = 1.0, .decimals = 1, .scale = kOf100, .values = {}},
      [](const std::array<double, 10>& values) { return sus_score(values); }, results);
  add_measure(
      gathered<6>(questions, "tlx-", condition_of),
      {.key = "tlx",
       .title = "NASA-TLX, raw",
       .unit = "of 100",
       .per_si = 1.0,
       .decimals = 1,
       .scale = kOf100,
       .values = {}},
      [](const std::array<double, 6>& values) { return tlx_raw(values); }, results);
  add_ssq(gathered<16>(questions, "ssq-", time_of), results);
}

Estimate Measure::mean(const std::string& condition) const {
  std::vector<double> list = values_of(values.at(condition));
  for (double& value : list) value = on_scale(*this, value);
  if (!logarithmic) return mean_estimate(list, scale);
  const Estimate estimate = mean_estimate(list);
  return {estimate.n, std::exp(estimate.value), {std::exp(estimate.interval.low), std::exp(estimate.interval.high)}};
}

double Measure::sd(const std::string& condition) const {
  return logarithmic ? kNoValue : summary_of(values_of(values.at(condition))).sd;
}

std::vector<ConditionComparison> compared_conditions(const Measure& measure) {
  std::vector<ConditionComparison> comparisons;
  for (auto a = measure.values.begin(); a != measure.values.end(); ++a) {
    for (auto b = std::next(a); b != measure.values.end(); ++b) {
      comparisons.push_back({measure.title, a->first, b->first, comparison_of(measure, a->second, b->second)});
    }
  }
  return comparisons;
}

TestResult as_result(const std::string& name, const TTest& test, const std::string& effect_name) {
  return {.name = name,
          .statistic = std::isnan(test.t) ? "" : fmt::format("t({:.4g}) = {:.3f}", test.degrees, test.t),
          .p = test.p,
          .effect_name = effect_name,
          .effect = test.d};
}

}  // namespace afm::study
