// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>

#include "study_page.h"

namespace afm::study {

namespace {

using Blocks = std::vector<PageBlock>;

void add_identify(const LessonResults& lesson, Blocks& blocks) {
  if (lesson.identify.empty()) return;
  blocks.push_back(PageHeading{3, "Blind identification"});
  PageTable table{
      {"Step", "Condition", "People", "Right", "Share right", "d' of a choice", "Kappa", "Information (bits)"}, {}};
  PageList tests;
  for (const IdentifyResult& result : lesson.identify) {
    const std::size_t right = result.matrix.right(), n = result.matrix.trials();
    table.rows.push_back({result.step, condition_text(result.condition), std::to_string(result.people.size()),
                          fmt::format("{} of {}", right, n), estimate_text(result.accuracy, 2),
                          estimate_text(result.d_prime, 2), number_text(result.matrix.kappa(), 2),
                          number_text(result.matrix.information_bits(), 2)});
    std::string line =
        fmt::format("{}, {}: {}", result.step, condition_text(result.condition), test_text(result.against_chance));
    if (result.needed) line += fmt::format(" (from {} right on, chance is below 5 %)", result.needed->right);
    tests.items.push_back(std::move(line));
  }
  blocks.push_back(std::move(table));
  blocks.push_back(std::move(tests));
  blocks.push_back(PageFigure{fmt::format("identify-{}.svg", lesson.task), identify_svg(lesson),
                              "Share right with its exact 95 % interval; the dashed lines are chance and all right."});
  for (const IdentifyResult& result : lesson.identify) {
    const std::string where = result.step + ", " + condition_text(result.condition);
    PageTable matrix{{"Shown (" + where + ")"}, {}};
    for (const std::string& name : result.matrix.names) matrix.columns.push_back("answered " + name);
    matrix.columns.insert(matrix.columns.end(), {"d' against the rest", "c", "d', log-linear", "c, log-linear"});
    for (std::size_t i = 0; i < result.matrix.names.size(); ++i) {
      std::vector<std::string> row{result.matrix.names[i]};
      for (const std::size_t count : result.matrix.counts[i]) row.push_back(std::to_string(count));
      const auto& [plain, corrected] = result.materials[i];
      row.push_back(number_text(plain.d_prime, 2));
      row.push_back(number_text(plain.criterion, 2));
      row.push_back(estimate_text({0, corrected.d_prime, corrected.d_prime_interval}, 2));
      row.push_back(estimate_text({0, corrected.criterion, corrected.criterion_interval}, 2));
      matrix.rows.push_back(std::move(row));
    }
    blocks.push_back(std::move(matrix));
    PageTable people{{"Participant (" + where + ")", "Right", "Share right", "d' of a choice"}, {}};
    for (const IdentifyResult::Person& person : result.people) {
      people.rows.push_back({person.id, fmt::format("{} of {}", person.right, person.accuracy.n),
                             estimate_text(person.accuracy, 2), estimate_text(person.d_prime, 2)});
    }
    blocks.push_back(std::move(people));
  }
}

void add_thresholds_page(const LessonResults& lesson, Blocks& blocks) {
  if (lesson.thresholds.empty()) return;
  blocks.push_back(PageHeading{3, "Threshold of the pull-off force"});
  PageTable means{{"Step", "Condition", "People", "Weber fraction, geometric mean"}, {}};
  for (const ThresholdResult& result : lesson.thresholds) {
    means.rows.push_back({result.step, condition_text(result.condition), std::to_string(result.people.size()),
                          estimate_text(result.weber_fraction, 3)});
  }
  blocks.push_back(std::move(means));
  blocks.push_back(PageFigure{fmt::format("threshold-{}.svg", lesson.task), thresholds_svg(lesson),
                              "Share right at each level with its exact 95 % interval, all people together; the dashed "
                              "lines are the threshold and chance."});
  for (const ThresholdResult& result : lesson.thresholds) {
    PageTable people{{fmt::format("Participant ({}, {})", result.step, condition_text(result.condition)), "Right",
                      "Weber fraction", "Bias towards the first", "d' (where all trials have one level)"},
                     {}};
    for (const ThresholdResult::Person& person : result.people) {
      people.rows.push_back({person.id, fmt::format("{} of {}", person.fit.right, person.fit.bias.n),
                             estimate_text(person.fit.weber_fraction, 3), estimate_text(person.fit.bias, 2),
                             estimate_text(person.d_prime, 2)});
    }
    blocks.push_back(std::move(people));
  }
}

void add_measures(const LessonResults& lesson, Blocks& blocks) {
  if (lesson.measures.empty()) return;
  blocks.push_back(PageHeading{3, "By person"});
  PageTable table{{"Measure", "Condition", "n", "Mean and 95 % interval", "SD", "Unit"}, {}};
  for (const Measure& measure : lesson.measures) {
    for (const auto& [condition, people] : measure.values) {
      Estimate mean = measure.mean(condition);
      for (double* value : {&mean.value, &mean.interval.low, &mean.interval.high}) *value *= measure.per_si;
      table.rows.push_back({measure.title + (measure.logarithmic ? " (geometric mean)" : ""), condition_text(condition),
                            std::to_string(people.size()), estimate_text(mean, measure.decimals),
                            number_text(measure.sd(condition) * measure.per_si, measure.decimals), measure.unit});
    }
  }
  blocks.push_back(std::move(table));
}

void add_comparisons(const LessonResults& lesson, Blocks& blocks) {
  if (lesson.comparisons.empty()) return;
  blocks.push_back(PageHeading{3, "Conditions compared"});
  PageList list;
  for (const ConditionComparison& comparison : lesson.comparisons) {
    list.items.push_back(fmt::format("{}, {} against {} (n = {}): {}", comparison.measure, condition_text(comparison.a),
                                     condition_text(comparison.b), comparison.test.effect.n,
                                     test_text(comparison.test)));
  }
  blocks.push_back(std::move(list));
}

void add_learning(const LessonResults& lesson, Blocks& blocks) {
  if (lesson.learning.empty()) return;
  blocks.push_back(PageHeading{3, "Before and after"});
  PageTable table{{"Step", "People", "Before", "After", "Normalised gain"}, {}};
  PageList tests;
  for (const LearningResult& result : lesson.learning) {
    table.rows.push_back({result.step, std::to_string(result.before.n), estimate_text(result.before, 2),
                          estimate_text(result.after, 2), number_text(result.gain, 2)});
    tests.items.push_back(result.step + ", " + test_text(result.change));
    tests.items.push_back(result.step + ", " + test_text(result.single_trials));
  }
  blocks.push_back(std::move(table));
  blocks.push_back(std::move(tests));
}

void add_ssq_page(const LessonResults& lesson, Blocks& blocks) {
  if (lesson.ssq.empty()) return;
  blocks.push_back(PageHeading{3, "Simulator sickness (SSQ)"});
  PageTable table{{"Scale", "n", "Before", "After", "Change"}, {}};
  for (const SsqResult& result : lesson.ssq) {
    table.rows.push_back({result.scale, std::to_string(result.before.n), estimate_text(result.before, 1),
                          estimate_text(result.after, 1), test_text(result.change)});
  }
  blocks.push_back(std::move(table));
  blocks.push_back(PageText{
      fmt::format("The stop rule (a total above 20, or any severe symptom) was reached by {}.",
                  lesson.ssq_stops == 1 ? "1 participant" : std::to_string(lesson.ssq_stops) + " participants")});
}

}  // namespace

std::string condition_text(const std::string& condition) { return condition.empty() ? "no condition" : condition; }

std::vector<PageBlock> lesson_blocks(const LessonResults& lesson) {
  Blocks blocks{PageHeading{2, "Lesson " + lesson.task + (lesson.title.empty() ? "" : ": " + lesson.title)}};
  PageList facts{{fmt::format("participants: {}{}", lesson.people,
                              lesson.simulated > 0 ? fmt::format(", of which simulated {}", lesson.simulated) : ""),
                  fmt::format("trials: {} counted, {} of practice (left out), {} without an answer (left out), {} in "
                              "which the force was not as the step sets it (left out)",
                              lesson.counted, lesson.practice, lesson.unanswered, lesson.not_felt)}};
  if (lesson.force_unknown > 0) {
    facts.items.push_back(
        fmt::format("force on the hand: not known for {} of the counted trials, whose data set has no column \"force\"",
                    lesson.force_unknown));
  }
  if (lesson.pushes.counted > 0) {
    facts.items.push_back(
        fmt::format("pushes of particles: {}; aids: the wall showed the particles in {}, pushes were taken back in {}",
                    lesson.pushes.counted, lesson.pushes.with_truth, lesson.pushes.with_undo));
  }
  facts.items.insert(facts.items.end(), lesson.facts.begin(), lesson.facts.end());
  for (const std::string& line : lesson.left_out) facts.items.push_back("left out: " + line);
  blocks.push_back(std::move(facts));
  add_identify(lesson, blocks);
  add_thresholds_page(lesson, blocks);
  add_learning(lesson, blocks);
  add_measures(lesson, blocks);
  add_comparisons(lesson, blocks);
  add_ssq_page(lesson, blocks);
  return blocks;
}

}  // namespace afm::study
