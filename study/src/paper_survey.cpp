// SPDX-License-Identifier: Apache-2.0
#include "study/paper_survey.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "study/proportions.h"

namespace afm::study {

namespace {

constexpr std::size_t kAnswers = kSurveyHighest + 1;
constexpr int kPeople = static_cast<int>(kSurveyPeople);
constexpr double kHalfOfLastDigit = 0.005 + 1e-9;

std::vector<double> answers_of(const AnswerCounts& counts) {
  std::vector<double> answers;
  for (std::size_t answer = 0; answer < counts.size(); ++answer) {
    answers.insert(answers.end(), static_cast<std::size_t>(counts[answer]), static_cast<double>(answer));
  }
  return answers;
}

bool prints_as(const AnswerCounts& counts, const SurveyQuestion& question) {
  const Summary summary = summary_of(answers_of(counts));
  return std::abs(summary.mean - question.mean) <= kHalfOfLastDigit &&
         std::abs(summary.sd - question.sd) <= kHalfOfLastDigit;
}

// Returns true also if `than` is NaN.
bool is_smaller(double p, double than) { return p < than || std::isnan(than); }

// Number of people with each difference; 0 is at kSurveyHighest.
using Differences = std::array<int, 2 * kSurveyHighest + 1>;

// Fills a table of two distributions cell by cell and reports each complete one as its differences.
class Pairings {
 public:
  Pairings(const AnswerCounts& a, const AnswerCounts& b, KindestPairing& kindest) : a_(a), b_(b), kindest_(kindest) {}

  void consider_all() { fill(0, 0); }

 private:
  void fill(std::size_t row, std::size_t column) {
    if (row == kAnswers) {
      consider();
      return;
    }
    if (column + 1 == kAnswers) {
      put(row, column, a_[row], row + 1, 0);  // remaining people of the row
      return;
    }
    for (int people = std::min(a_[row], b_[column]); people >= 0; --people) {
      put(row, column, people, row, column + 1);
    }
  }

  void put(std::size_t row, std::size_t column, int people, std::size_t next_row, std::size_t next_column) {
    if (people > b_[column]) return;
    const std::size_t difference = row + kSurveyHighest - column;
    a_[row] -= people;
    b_[column] -= people;
    differences_[difference] += people;
    fill(next_row, next_column);
    a_[row] += people;
    b_[column] += people;
    differences_[difference] -= people;
  }

  void consider() {
    ++kindest_.tables;
    std::vector<double> list;
    for (std::size_t i = 0; i < differences_.size(); ++i) {
      list.insert(list.end(), static_cast<std::size_t>(differences_[i]), static_cast<double>(i) - kSurveyHighest);
    }
    if (const TTest t = paired_test(list); is_smaller(t.p, kindest_.t.p)) kindest_.t = t;
    if (TestResult sign = sign_test(list); is_smaller(sign.p, kindest_.sign.p)) kindest_.sign = std::move(sign);
  }

  AnswerCounts a_, b_;
  Differences differences_{};
  KindestPairing& kindest_;
};

}  // namespace

const std::array<SurveyQuestion, 8>& survey_questions() {
  static constexpr std::array<SurveyQuestion, 8> kQuestions{
      {{"paper-1", "AFM manipulation", "How much did the AFM simulation add to your understanding of AFM manipulation?",
        3.50, 0.61},
       {"paper-2", "approach-retract phenomenon",
        "How much did the AFM simulation add to your understanding of Approach-retract phenomenon?", 3.45, 0.69},
       {"paper-3", "force-displacement curves",
        "How much did the AFM simulation add to your understanding of Force-displacement curves?", 3.50, 0.61},
       {"paper-4", "haptic interface",
        "How much did the haptic interface help you understand those concepts listed above?", 3.35, 0.81},
       {"paper-5", "3D graphics", "How much did the 3D graphics help you understand those concepts listed above?", 3.15,
        0.75},
       {"paper-6", "interesting", "How interesting was the AFM simulations?", 3.80, 0.41},
       {"paper-7", "other simulations helpful",
        "Do you believe other virtual reality simulations would be helpful in increasing your understanding of "
        "nanoscale phenomenon?",
        4.00, 0.00},
       {"paper-8", "interest in the nanoscale",
        "How much did the AFM simulation increase your interest in nanoscale phenomenon?", 3.25, 0.79}}};
  return kQuestions;
}

Summary printed_summary(const SurveyQuestion& question) { return {kSurveyPeople, question.mean, question.sd}; }

std::vector<AnswerCounts> answers_that_print_as(const SurveyQuestion& question) {
  std::vector<AnswerCounts> found;
  AnswerCounts counts{};
  for (counts[0] = 0; counts[0] <= kPeople; ++counts[0]) {
    for (counts[1] = 0; counts[0] + counts[1] <= kPeople; ++counts[1]) {
      for (counts[2] = 0; counts[0] + counts[1] + counts[2] <= kPeople; ++counts[2]) {
        const int left = kPeople - counts[0] - counts[1] - counts[2];
        for (counts[3] = 0; counts[3] <= left; ++counts[3]) {
          counts[4] = left - counts[3];
          if (prints_as(counts, question)) found.push_back(counts);
        }
      }
    }
  }
  return found;
}

KindestPairing kindest_pairing(const std::vector<AnswerCounts>& a, const std::vector<AnswerCounts>& b) {
  KindestPairing kindest;
  for (const AnswerCounts& first : a) {
    for (const AnswerCounts& second : b) Pairings(first, second, kindest).consider_all();
  }
  return kindest;
}

}  // namespace afm::study
