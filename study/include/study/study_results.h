// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/detection.h"
#include "study/interval.h"
#include "study/means.h"
#include "study/paper_survey.h"
#include "study/proportions.h"
#include "study/study_data.h"
#include "study/threshold.h"

namespace afm::study {

// Results of a study's counted trials, pooled over its people, without practice trials and trials without an answer.
// Everything is in a fixed order: the same data give the same results, bit for bit.

// A step of blind identification under one condition (empty: the lesson has none).
struct IdentifyResult {
  std::string step, condition;
  ConfusionMatrix matrix;
  Estimate accuracy;                    // share of right answers in all trials
  double chance = kNoValue;             // accuracy of guessing, 1 divided by the number of materials
  TestResult against_chance;            // exact binomial test against guessing
  std::optional<SmallestCount> needed;  // smallest number of right answers that is improbable by guessing
  Estimate d_prime;                     // d' of an unbiased choice among the materials
  struct Material {
    YesNo plain, corrected;  // one material against all others, with unchanged and log-linear rates
  };
  std::vector<Material> materials;  // results in the order of the matrix
  struct Person {
    std::string id;
    std::size_t right = 0;
    Estimate accuracy, d_prime;
  };
  std::vector<Person> people;
};

// A step that measures a threshold, under one condition.
struct ThresholdResult {
  std::string step, condition;
  struct Person {
    std::string id;
    ThresholdFit fit;
    Estimate d_prime;  // d' of two intervals, if all trials have one level
  };
  std::vector<Person> people;
  Estimate weber_fraction;  // geometric mean over people with its t interval in logarithms
  struct Level {
    double level;
    Estimate right;
  };
  std::vector<Level> levels;  // levels of all people, ascending
};

// A value for each person under each condition: "SUS", "right answers in blind".
struct Measure {
  std::string key, title, unit;
  double per_si = 1.0;  // displayed units per SI unit
  int decimals = 2;
  bool logarithmic = false;                                     // true: compared by ratios
  Interval scale{-kUnbounded, kUnbounded};                      // range of legal values, SI
  std::map<std::string, std::map<std::string, double>> values;  // values by condition and person

  Estimate mean(const std::string& condition) const;  // mean in SI, geometric if logarithmic
  double sd(const std::string& condition) const;      // standard deviation; NaN if logarithmic
};

// Two conditions of a measure; paired for those who did both, otherwise for different people.
struct ConditionComparison {
  std::string measure, a, b;
  TestResult test;
};

// A score of the SSQ, before and after, from those who answered both times.
struct SsqResult {
  std::string scale;
  Estimate before, after;
  TestResult change;
};

// A step done before and after (steps "NAME-before" and "NAME-after").
struct LearningResult {
  std::string step;
  Estimate before, after;  // proportion of right answers by person
  double gain = kNoValue;  // Hake's gain of the means
  TestResult change, single_trials;
};

struct LessonResults {
  std::string task, title;
  std::vector<std::string> facts;  // lines on the conditions, "device: sim", one for each difference
  std::size_t people = 0, simulated = 0, counted = 0, practice = 0, unanswered = 0;
  std::size_t not_felt = 0;           // trials left out because the force was on or off contrary to the condition
  std::size_t force_unknown = 0;      // counted trials of data without information on the force
  std::vector<std::string> left_out;  // questionnaires left out because they are incomplete
  struct Pushes {
    std::size_t counted = 0;
    std::size_t with_truth = 0, with_undo = 0;  // pushes with an aid: the truth shown, a push undone
  };
  Pushes pushes;
  std::vector<IdentifyResult> identify;
  std::vector<ThresholdResult> thresholds;
  std::vector<Measure> measures;
  std::vector<ConditionComparison> comparisons;
  std::vector<LearningResult> learning;
  std::vector<SsqResult> ssq;
  std::size_t ssq_stops = 0;  // number of people who reached the stop rule
};

// Answers of this study to a question of Table 3.
struct SurveyResult {
  Summary answers;
  Interval interval;
  TestResult against_paper;
};

struct StudyResults {
  std::size_t listed = 0, people = 0;
  std::map<std::string, std::size_t> ages;  // number of people in each age band
  std::vector<std::string> left_out, remarks;
  std::vector<SurveyResult> survey;  // results for the paper's eight questions; empty if nobody was asked
  double survey_alpha = kNoValue, sus_alpha = kNoValue;
  std::vector<TestResult> haptics_against_graphics;  // paired tests of this study
  std::vector<LessonResults> lessons;                // lessons sorted by task
};

StudyResults study_results(const StudyData& data);

// The result of a t test with its effect, as reports print it.
TestResult as_result(const std::string& name, const TTest& test, const std::string& effect_name);

}  // namespace afm::study
