// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>

namespace afm::study {

// Scores of published questionnaires. Answers are in the order of the items. The caller must ensure that every answer
// exists and is within its range.

// System Usability Scale (Brooke 1996), 0..100: ten answers from 1 to 5, of which odd ones count x-1, even ones 5-x,
// times 2.5.
double sus_score(std::span<const double, 10> answers);

// NASA Task Load Index (Hart & Staveland 1988), 0..100: six ratings from 0 to 100. Raw: their mean (Hart 2006).
double tlx_raw(std::span<const double, 6> ratings);

// Simulator Sickness Questionnaire (Kennedy, Lane, Berbaum & Lilienthal 1993): sixteen answers from 0 (none) to 3
// (severe). Raw sums times 9.54, 7.58, 13.92; the total is 3.74 times the sum of the three raw sums, in which items of
// two scales count twice.
struct SsqScores {
  double nausea = 0, oculomotor = 0, disorientation = 0, total = 0;
};
SsqScores ssq_scores(std::span<const double, 16> answers);

// Limits at which a session ends: a total above the first, or any answer "severe" (TouchAFM's rule, not Kennedy's).
inline constexpr double kSsqStopTotal = 20.0;
inline constexpr double kSsqSevere = 3.0;
bool ssq_says_stop(std::span<const double, 16> answers);

}  // namespace afm::study
