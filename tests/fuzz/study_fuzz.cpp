// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuzz/accepted.h"
#include "study/study_data.h"

// Whatever the bytes of a study's files: trials within the ranges of their columns, or an error that names the line.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(bytes), size);
  const auto people = afm::study::parse_people(text, "x");
  const auto facts = afm::study::parse_lesson_facts(text, "x");
  const auto events = afm::study::parse_events(text, "x");
  if (people || facts || events) ++afm::fuzz::accepted_inputs;
  if (!events) return 0;
  for (const afm::study::StudyTrial& trial : events->trials) {
    if (!std::isfinite(trial.onset_s) || trial.trial < 1 || trial.step.empty()) std::abort();
    if (trial.value && !std::isfinite(*trial.value)) std::abort();
    if (trial.right && trial.response.empty()) std::abort();
  }
  return 0;
}
