// SPDX-License-Identifier: Apache-2.0
#include "study/questionnaires.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace afm::study {

namespace {

// Numbers of the items, from 1 (Kennedy et al. 1993, table 5).
constexpr std::array<std::size_t, 7> kNausea{1, 6, 7, 8, 9, 15, 16};
constexpr std::array<std::size_t, 7> kOculomotor{1, 2, 3, 4, 5, 9, 11};
constexpr std::array<std::size_t, 7> kDisorientation{5, 8, 10, 11, 12, 13, 14};

double raw_sum(std::span<const double, 16> answers, const std::array<std::size_t, 7>& items) {
  double sum = 0.0;
  for (const std::size_t item : items) sum += answers[item - 1];
  return sum;
}

}  // namespace

double sus_score(std::span<const double, 10> answers) {
  double sum = 0.0;
  for (std::size_t i = 0; i < answers.size(); ++i) sum += i % 2 == 0 ? answers[i] - 1.0 : 5.0 - answers[i];
  return 2.5 * sum;
}

double tlx_raw(std::span<const double, 6> ratings) {
  return std::accumulate(ratings.begin(), ratings.end(), 0.0) / static_cast<double>(ratings.size());
}

SsqScores ssq_scores(std::span<const double, 16> answers) {
  const double n = raw_sum(answers, kNausea), o = raw_sum(answers, kOculomotor), d = raw_sum(answers, kDisorientation);
  return {9.54 * n, 7.58 * o, 13.92 * d, 3.74 * (n + o + d)};
}

bool ssq_says_stop(std::span<const double, 16> answers) {
  return ssq_scores(answers).total > kSsqStopTotal ||
         std::any_of(answers.begin(), answers.end(), [](double answer) { return answer >= kSsqSevere; });
}

}  // namespace afm::study
