// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/enumerators.h"
#include "exhibit/lesson/lesson.h"
#include "exhibit/words/phrases.h"

namespace afm::exhibit {

// A questionnaire: its items are consecutive phrases; its answers are equal steps from `least` to `most`.
struct QuestionnaireRow {
  Questionnaire questionnaire;
  std::string_view word;  // name in lesson files and in the items' ids: "sus-3"
  Phrase first_item;
  std::size_t items;
  int least, most, step;
  Phrase first_answer;  // first phrase of the answers: one for each answer, or for the two ends of the scale
  std::size_t answer_phrases;
};

// Liu & Peng's Table 3 (0 not at all to 4 very much), the System Usability Scale (Brooke 1996), NASA's Task Load Index
// (Hart & Staveland 1988), the Simulator Sickness Questionnaire (Kennedy et al. 1993).
inline constexpr std::array kQuestionnaires{
    QuestionnaireRow{Questionnaire::Paper, "paper", Phrase::Paper1, 8, 0, 4, 1, Phrase::PaperAnswer0, 5},
    QuestionnaireRow{Questionnaire::Sus, "sus", Phrase::Sus1, 10, 1, 5, 1, Phrase::SusAnswer1, 5},
    QuestionnaireRow{Questionnaire::Tlx, "tlx", Phrase::Tlx1, 6, 0, 100, 5, Phrase::TlxLow, 2},
    QuestionnaireRow{Questionnaire::Ssq, "ssq", Phrase::Ssq1, 16, 0, 3, 1, Phrase::SsqAnswer0, 4}};
static_assert(core::has_row_for_each(kQuestionnaires, &QuestionnaireRow::questionnaire));
constexpr const QuestionnaireRow& row_of(Questionnaire which) { return kQuestionnaires[core::index_of(which)]; }

// "ssq-7"; `item` counts from 0.
std::string item_id(Questionnaire which, std::size_t item);

// Texts of the answers, in order: "0", "5 ..." if a scale has more answers than phrases.
std::vector<std::string> answers_of(Questionnaire which, const Phrases& phrases);

// Numeric value of an answer.
int value_of(Questionnaire which, std::size_t answer);

}  // namespace afm::exhibit
