// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "study_groups.h"

namespace afm::study {

namespace {

constexpr double kRareByChance = 0.05;
constexpr std::string_view kBefore = "-before", kAfter = "-after";

std::size_t count_right(const std::vector<const StudyTrial*>& trials) {
  return static_cast<std::size_t>(std::count_if(trials.begin(), trials.end(),
                                                [](const StudyTrial* trial) { return trial->right.value_or(false); }));
}

ConfusionMatrix matrix_of(const TrialsByPerson& people, const std::set<std::string>& names) {
  ConfusionMatrix matrix{{names.begin(), names.end()}, {}};
  matrix.counts.assign(names.size(), std::vector<std::size_t>(names.size()));
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::distance(names.begin(), names.find(name)));
  };
  for (const auto& [id, trials] : people) {
    for (const StudyTrial* trial : trials) ++matrix.counts[place(trial->stimulus)][place(trial->response)];
  }
  return matrix;
}

double share_right(const std::vector<const StudyTrial*>& trials) {
  return trials.empty() ? kNoValue : static_cast<double>(count_right(trials)) / static_cast<double>(trials.size());
}

// Compares two groups of one step: the same people's shares, and their trials of the same number.
LearningResult learning_of(const std::string& step, const TrialsByPerson& before, const TrialsByPerson& after) {
  LearningResult result{.step = step, .before = {}, .after = {}, .change = {}, .single_trials = {}};
  std::vector<double> pre, post, differences;
  std::size_t up = 0, down = 0;
  for (const auto& [id, trials] : before) {
    const auto found = after.find(id);
    if (found == after.end()) continue;
    pre.push_back(share_right(trials));
    post.push_back(share_right(found->second));
    differences.push_back(post.back() - pre.back());
    std::map<int, bool> was_right;
    for (const StudyTrial* trial : trials) was_right[trial->trial] = *trial->right;
    for (const StudyTrial* trial : found->second) {
      const auto same = was_right.find(trial->trial);
      if (same == was_right.end() || same->second == *trial->right) continue;
      ++(same->second ? down : up);
    }
  }
  result.before = mean_estimate(pre, kShares);
  result.after = mean_estimate(post, kShares);
  result.gain = normalised_gain(result.before.value, result.after.value);
  result.change = as_result("paired t", paired_test(differences), "d_z");
  result.single_trials = sign_test(up, down);
  result.single_trials.name = "McNemar, exact, trials of the same number";
  return result;
}

}  // namespace

std::map<std::string, std::set<std::string>> materials_of_steps(const TrialGroups& identify) {
  std::map<std::string, std::set<std::string>> materials;
  for (const auto& [where, people] : identify) {
    for (const auto& [id, trials] : people) {
      for (const StudyTrial* trial : trials) materials[where.step].insert({trial->stimulus, trial->response});
    }
  }
  return materials;
}

IdentifyResult identify_result(const StepAndCondition& where, const TrialsByPerson& trials,
                               const std::set<std::string>& materials) {
  IdentifyResult result{.step = where.step,
                        .condition = where.condition,
                        .matrix = matrix_of(trials, materials),
                        .accuracy = {},
                        .against_chance = {},
                        .needed = {},
                        .d_prime = {},
                        .materials = {},
                        .people = {}};
  const std::size_t n = result.matrix.trials(), right = result.matrix.right();
  // a choice needs at least two materials
  const int names = std::max(2, static_cast<int>(result.matrix.names.size()));
  result.chance = 1.0 / names;
  result.accuracy = proportion(right, n);
  result.d_prime = choice_estimate(right, n, names);
  result.needed = smallest_count_above_chance(n, result.chance, kRareByChance);
  result.against_chance = {.name = "binomial against chance, exact, one-sided",
                           .statistic = fmt::format("{} of {} right, chance 1/{}", right, n, names),
                           .p = p_of_at_least(right, n, result.chance),
                           .effect_name = "share right",
                           .effect = result.accuracy};
  for (std::size_t i = 0; i < result.matrix.names.size(); ++i) {
    const YesNoCounts counts = result.matrix.against_the_rest(i);
    result.materials.push_back({yes_no(counts, RateCorrection::None), yes_no(counts, RateCorrection::LogLinear)});
  }
  for (const auto& [id, list] : trials) {
    const std::size_t of_person = count_right(list);
    result.people.push_back(
        {id, of_person, proportion(of_person, list.size()), choice_estimate(of_person, list.size(), names)});
  }
  return result;
}

ThresholdResult threshold_result(const StepAndCondition& where, const TrialsByPerson& trials) {
  ThresholdResult result{
      .step = where.step, .condition = where.condition, .people = {}, .weber_fraction = {}, .levels = {}};
  std::map<double, std::pair<std::size_t, std::size_t>> by_level;  // numbers of right answers and of answers
  std::vector<double> logarithms;
  for (const auto& [id, list] : trials) {
    std::vector<ThresholdTrial> converted;
    std::set<double> levels;
    for (const StudyTrial* trial : list) {
      converted.push_back({.level = *trial->level,
                           .second_stronger = trial->stimulus == "second",
                           .answered_second = trial->response == "second"});
      levels.insert(*trial->level);
      by_level[*trial->level].first += converted.back().right() ? 1U : 0U;
      ++by_level[*trial->level].second;
    }
    ThresholdResult::Person person{.id = id, .fit = fitted_threshold(converted), .d_prime = {}};
    if (levels.size() == 1) person.d_prime = two_interval_estimate(person.fit.right, list.size());
    if (person.fit.weber_fraction.value > 0.0) logarithms.push_back(std::log(person.fit.weber_fraction.value));
    result.people.push_back(person);
  }
  const Estimate mean = mean_estimate(logarithms);
  result.weber_fraction = {mean.n, std::exp(mean.value), {std::exp(mean.interval.low), std::exp(mean.interval.high)}};
  for (const auto& [level, counts] : by_level)
    result.levels.push_back({level, proportion(counts.first, counts.second)});
  return result;
}

std::vector<LearningResult> learning_results(const TrialGroups& identify) {
  std::map<std::string, TrialsByPerson> by_step;
  for (const auto& [where, people] : identify) {
    for (const auto& [id, trials] : people) {
      auto& list = by_step[where.step][id];
      list.insert(list.end(), trials.begin(), trials.end());
    }
  }
  std::vector<LearningResult> results;
  for (const auto& [step, people] : by_step) {
    if (!step.ends_with(kBefore)) continue;
    const std::string stem = step.substr(0, step.size() - kBefore.size());
    const auto after = by_step.find(stem + std::string(kAfter));
    if (after != by_step.end()) results.push_back(learning_of(stem, people, after->second));
  }
  return results;
}

}  // namespace afm::study
