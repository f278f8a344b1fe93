// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "core/written_by.h"
#include "study/study_report.h"
#include "study/survey_report.h"
#include "study_page.h"

namespace afm::study {

namespace {

using Json = nlohmann::ordered_json;

Json condition_json(const std::string& condition) { return condition.empty() ? Json() : Json(condition); }

Json yes_no_json(const YesNo& answers) {
  return {{"d_prime", json_of(answers.d_prime)}, {"criterion", json_of(answers.criterion)}};
}

Json identify_json(const IdentifyResult& result) {
  Json materials = Json::array(), people = Json::array();
  for (std::size_t i = 0; i < result.materials.size(); ++i) {
    const auto& [plain, corrected] = result.materials[i];
    Json entry{{"material", result.matrix.names[i]}, {"against_the_rest", yes_no_json(plain)}};
    entry["log_linear"] = {
        {"d_prime", json_of(Estimate{result.matrix.trials(), corrected.d_prime, corrected.d_prime_interval})},
        {"criterion", json_of(Estimate{result.matrix.trials(), corrected.criterion, corrected.criterion_interval})}};
    materials.push_back(std::move(entry));
  }
  for (const IdentifyResult::Person& person : result.people) {
    people.push_back({{"participant", person.id},
                      {"right", person.right},
                      {"share_right", json_of(person.accuracy)},
                      {"d_prime", json_of(person.d_prime)}});
  }
  Json needed;
  if (result.needed) needed = {{"right", result.needed->right}, {"probability_by_chance", result.needed->p}};
  return {{"step", result.step},
          {"condition", condition_json(result.condition)},
          {"materials", result.matrix.names},
          {"confusion_shown_answered", result.matrix.counts},
          {"trials", result.matrix.trials()},
          {"right", result.matrix.right()},
          {"accuracy", json_of(result.accuracy)},
          {"chance", result.chance},
          {"against_chance", json_of(result.against_chance)},
          {"needed", needed},
          {"d_prime_of_choice", json_of(result.d_prime)},
          {"kappa", json_of(result.matrix.kappa())},
          {"information_bits", json_of(result.matrix.information_bits())},
          {"by_material", materials},
          {"by_participant", people}};
}

Json threshold_json(const ThresholdResult& result) {
  Json people = Json::array(), levels = Json::array();
  for (const ThresholdResult::Person& person : result.people) {
    people.push_back({{"participant", person.id},
                      {"right", person.fit.right},
                      {"weber_fraction", json_of(person.fit.weber_fraction)},
                      {"bias", json_of(person.fit.bias)},
                      {"d_prime", json_of(person.d_prime)}});
  }
  for (const ThresholdResult::Level& level : result.levels) {
    levels.push_back({{"level", level.level}, {"share_right", json_of(level.right)}});
  }
  return {{"step", result.step},
          {"condition", condition_json(result.condition)},
          {"weber_fraction", json_of(result.weber_fraction)},
          {"by_participant", people},
          {"by_level", levels}};
}

Json measure_json(const Measure& measure) {
  Json conditions = Json::array();
  for (const auto& [condition, people] : measure.values) {
    conditions.push_back({{"condition", condition_json(condition)},
                          {"mean", json_of(measure.mean(condition))},
                          {"sd", json_of(measure.sd(condition))},
                          {"by_participant", people}});
  }
  return {{"measure", measure.key},
          {"title", measure.title},
          {"geometric", measure.logarithmic},
          {"conditions", conditions}};
}

template <class List, class ToJson>
Json array_of(const List& list, const ToJson& to_json) {
  Json array = Json::array();
  for (const auto& each : list) array.push_back(to_json(each));
  return array;
}

Json lesson_json(const LessonResults& lesson) {
  return {{"lesson", lesson.task},
          {"title", lesson.title},
          {"facts", lesson.facts},
          {"participants", lesson.people},
          {"simulated", lesson.simulated},
          {"trials",
           {{"counted", lesson.counted},
            {"practice", lesson.practice},
            {"unanswered", lesson.unanswered},
            {"not_felt", lesson.not_felt},
            {"force_unknown", lesson.force_unknown}}},
          {"pushes",
           {{"counted", lesson.pushes.counted},
            {"with_truth", lesson.pushes.with_truth},
            {"with_undo", lesson.pushes.with_undo}}},
          {"left_out", lesson.left_out},
          {"identify", array_of(lesson.identify, identify_json)},
          {"thresholds", array_of(lesson.thresholds, threshold_json)},
          {"measures", array_of(lesson.measures, measure_json)},
          {"comparisons", array_of(lesson.comparisons,
                                   [](const ConditionComparison& each) -> Json {
                                     return {{"measure", each.measure},
                                             {"a", condition_json(each.a)},
                                             {"b", condition_json(each.b)},
                                             {"test", json_of(each.test)},
                                             {"p_holm", json_of(each.test.holm_p)}};
                                   })},
          {"learning", array_of(lesson.learning,
                                [](const LearningResult& each) -> Json {
                                  return {{"step", each.step},
                                          {"before", json_of(each.before)},
                                          {"after", json_of(each.after)},
                                          {"normalised_gain", json_of(each.gain)},
                                          {"change", json_of(each.change)},
                                          {"single_trials", json_of(each.single_trials)}};
                                })},
          {"ssq", array_of(lesson.ssq,
                           [](const SsqResult& each) -> Json {
                             return {{"scale", each.scale},
                                     {"before", json_of(each.before)},
                                     {"after", json_of(each.after)},
                                     {"change", json_of(each.change)}};
                           })},
          {"ssq_stops", lesson.ssq_stops}};
}

}  // namespace

std::string study_json(const StudyResults& results) {
  Json survey = Json::array();
  for (std::size_t i = 0; i < results.survey.size(); ++i) {
    const SurveyResult& here = results.survey[i];
    survey.push_back({{"item", survey_questions()[i].item},
                      {"mean", json_of(Estimate{here.answers.n, here.answers.mean, here.interval})},
                      {"sd", json_of(here.answers.sd)},
                      {"against_paper", json_of(here.against_paper)}});
  }
  const auto test = [](const TestResult& each) { return json_of(each); };
  Json root{{"listed", results.listed},
            {"participants", results.people},
            {"ages", results.ages},
            {"left_out", results.left_out},
            {"remarks", results.remarks},
            {"lessons", array_of(results.lessons, lesson_json)},
            {"survey", survey},
            {"haptics_against_graphics", array_of(results.haptics_against_graphics, test)},
            {"cronbach_alpha", {{"survey", json_of(results.survey_alpha)}, {"sus", json_of(results.sus_alpha)}}},
            {"paper_table3", paper_survey_json()}};
  core::name_software(root);
  return root.dump(2) + "\n";
}

}  // namespace afm::study
