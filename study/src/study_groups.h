// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "study/study_results.h"

namespace afm::study {

// Counted trials of a lesson with an answer, by step and condition, then by person.
using TrialsByPerson = std::map<std::string, std::vector<const StudyTrial*>>;
struct StepAndCondition {
  std::string step, condition;
  auto operator<=>(const StepAndCondition&) const = default;
};
using TrialGroups = std::map<StepAndCondition, TrialsByPerson>;

// The materials shown or answered in each step, under any condition.
std::map<std::string, std::set<std::string>> materials_of_steps(const TrialGroups& identify);

IdentifyResult identify_result(const StepAndCondition& where, const TrialsByPerson& trials,
                               const std::set<std::string>& materials);
ThresholdResult threshold_result(const StepAndCondition& where, const TrialsByPerson& trials);
std::vector<LearningResult> learning_results(const TrialGroups& identify);

// Newest answers of each person to a questionnaire's items, by condition or another word.
template <std::size_t items>
using Answers = std::map<std::string, std::map<std::string, std::array<std::optional<double>, items>>>;

// Index of a question's item, from 0; empty for another questionnaire.
std::optional<std::size_t> item_of(const StudyTrial& trial, std::string_view questionnaire);

// Adds measures, SSQ and incomplete questionnaires of a lesson.
void add_questionnaires(const std::map<std::string, std::vector<const StudyTrial*>>& questions, LessonResults& results);

std::vector<ConditionComparison> compared_conditions(const Measure& measure);

}  // namespace afm::study
