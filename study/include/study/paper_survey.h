// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "study/means.h"

namespace afm::study {

// The survey of Liu & Peng, Table 3: twenty people, eight questions, answers from 0 to 4.
struct SurveyQuestion {
  std::string_view item;  // name of the item in data sets, "paper-1"
  std::string_view short_name;
  std::string_view text;  // text as printed in the paper
  double mean, sd;        // values printed with two decimals; the SD has the divisor n-1
};

inline constexpr std::size_t kSurveyPeople = 20;
inline constexpr int kSurveyHighest = 4;
inline constexpr std::size_t kHapticsQuestion = 3, kGraphicsQuestion = 4;  // indices in survey_questions()
const std::array<SurveyQuestion, 8>& survey_questions();

// The printed numbers as the summary of a sample of 20.
Summary printed_summary(const SurveyQuestion& question);

// Number of the 20 people who gave each answer.
using AnswerCounts = std::array<int, kSurveyHighest + 1>;

// Every distribution of 20 integer answers whose mean and SD round to the printed ones, by rising counts of the lowest
// answers (after GRIM, Brown & Heathers 2017, and SPRITE, Heathers et al. 2018; tries all 10626).
std::vector<AnswerCounts> answers_that_print_as(const SurveyQuestion& question);

// Results over all pairings in which the same 20 people can have given two distributions of answers: the number of
// pairings, and the smallest two-sided p of the paired t test and of the sign test, with their effects.
struct KindestPairing {
  std::size_t tables = 0;
  TTest t;          // t test with the smallest p
  TestResult sign;  // sign test with the smallest p
};
KindestPairing kindest_pairing(const std::vector<AnswerCounts>& a, const std::vector<AnswerCounts>& b);

}  // namespace afm::study
