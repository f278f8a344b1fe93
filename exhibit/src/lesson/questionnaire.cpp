// SPDX-License-Identifier: Apache-2.0
#include "exhibit/lesson/questionnaire.h"

#include <fmt/format.h>

namespace afm::exhibit {

std::string item_id(Questionnaire which, std::size_t item) {
  return fmt::format("{}-{}", row_of(which).word, item + 1);
}

std::vector<std::string> answers_of(Questionnaire which, const Phrases& phrases) {
  const QuestionnaireRow& row = row_of(which);
  const auto count = static_cast<std::size_t>((row.most - row.least) / row.step) + 1;
  std::vector<std::string> answers;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string number = std::to_string(value_of(which, i));
    if (count == row.answer_phrases) {
      answers.push_back(phrases[after(row.first_answer, i)]);
    } else if (i == 0 || i + 1 == count) {
      answers.push_back(number + " " + phrases[after(row.first_answer, i == 0 ? 0 : 1)]);
    } else {
      answers.push_back(number);
    }
  }
  return answers;
}

int value_of(Questionnaire which, std::size_t answer) {
  return row_of(which).least + static_cast<int>(answer) * row_of(which).step;
}

}  // namespace afm::exhibit
