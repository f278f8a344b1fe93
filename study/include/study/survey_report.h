// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/report_page.h"

namespace afm::study {

// Conclusions that the paper's Table 3 supports and those that it does not, computed only from its printed means and
// SDs.
std::vector<PageBlock> paper_survey_blocks();
nlohmann::ordered_json paper_survey_json();

// Number in JSON; null for a missing value.
nlohmann::ordered_json json_of(double value);
nlohmann::ordered_json json_of(const Estimate& estimate);
nlohmann::ordered_json json_of(const TestResult& test);

}  // namespace afm::study
