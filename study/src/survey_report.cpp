// SPDX-License-Identifier: Apache-2.0
#include "study/survey_report.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/paper_survey.h"
#include "study/study_results.h"

namespace afm::study {

namespace {

using Json = nlohmann::ordered_json;

struct HapticsAgainstGraphics {
  TestResult unpaired, paired, sign;
  std::size_t tables;
};

HapticsAgainstGraphics computed_comparison() {
  const SurveyQuestion& haptics = survey_questions()[kHapticsQuestion];
  const SurveyQuestion& graphics = survey_questions()[kGraphicsQuestion];
  const KindestPairing kindest = kindest_pairing(answers_that_print_as(haptics), answers_that_print_as(graphics));
  HapticsAgainstGraphics result{
      as_result("Welch t", welch_test(printed_summary(haptics), printed_summary(graphics)), "d"),
      as_result("paired t", kindest.t, "d_z"), kindest.sign, kindest.tables};
  result.sign.effect_name = "share that found haptics more helpful, of those who differ";
  return result;
}

const HapticsAgainstGraphics& haptics_against_graphics() {
  static const HapticsAgainstGraphics kComparison = computed_comparison();
  return kComparison;
}

}  // namespace

std::vector<PageBlock> paper_survey_blocks() {
  PageTable table{{"Question", "Mean", "SD", "95 % interval", "Distributions of 20 answers that print so"}, {}};
  for (const SurveyQuestion& question : survey_questions()) {
    table.rows.push_back({std::string(question.text), number_text(question.mean, 2), number_text(question.sd, 2),
                          interval_text(t_interval(printed_summary(question)), 2),
                          std::to_string(answers_that_print_as(question).size())});
  }
  const HapticsAgainstGraphics& tests = haptics_against_graphics();
  return {PageText{"The survey of twenty people, answers from 0 (not at all) to 4 (a great deal), and what its printed "
                   "numbers can bear."},
          table,
          PageText{"Table 3 is consistent: for each question there is at least one set of twenty whole answers with "
                   "the printed mean and SD (that of a sample, divided by n - 1)."},
          PageText{"\"Haptics were more helpful than graphics\" does not follow from it. Taken as two groups, the "
                   "difference of 0.20 may be chance. The same people answered both questions, but which answers "
                   "belong together is not printed:"},
          PageList{{test_text(tests.unpaired),
                    fmt::format("the kindest of all {} possible pairings, {}", tests.tables, test_text(tests.paired)),
                    "the kindest pairing, " + test_text(tests.sign)}},
          PageText{"The paper names no group without haptics, no question before, and no test of what was understood: "
                   "Table 3 says what people thought that they had learned."}};
}

Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json json_of(const Estimate& estimate) {
  return {{"n", estimate.n},
          {"value", json_of(estimate.value)},
          {"low", json_of(estimate.interval.low)},
          {"high", json_of(estimate.interval.high)}};
}

Json json_of(const TestResult& test) {
  Json json{{"test", test.name},
            {"statistic", test.statistic},
            {"p", json_of(test.p)},
            {"effect", test.effect_name},
            {"effect_size", json_of(test.effect)}};
  if (!std::isnan(test.holm_p)) json["p_holm"] = test.holm_p;
  return json;
}

Json paper_survey_json() {
  Json questions = Json::array();
  for (const SurveyQuestion& question : survey_questions()) {
    const Interval interval = t_interval(printed_summary(question));
    Json distributions = Json::array();
    for (const AnswerCounts& counts : answers_that_print_as(question)) distributions.push_back(counts);
    questions.push_back({{"question", question.text},
                         {"n", kSurveyPeople},
                         {"mean", question.mean},
                         {"sd", question.sd},
                         {"low", interval.low},
                         {"high", interval.high},
                         {"counts_that_print_so", distributions}});
  }
  const HapticsAgainstGraphics& tests = haptics_against_graphics();
  return {{"questions", questions},
          {"consistent", true},
          {"haptics_more_helpful_than_graphics_follows", false},
          {"haptics_against_graphics",
           {{"unpaired", json_of(tests.unpaired)},
            {"pairings", tests.tables},
            {"kindest_paired_t", json_of(tests.paired)},
            {"kindest_sign_test", json_of(tests.sign)}}}};
}

}  // namespace afm::study
