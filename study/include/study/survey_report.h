// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "study/report_page.h"

namespace afm::study {

// What the paper's Table 3 shows and what it does not: computed from its printed means and SDs alone.
std::vector<PageBlock> paper_survey_blocks();
nlohmann::ordered_json paper_survey_json();

// Numbers of results in JSON: what has no value is null.
nlohmann::ordered_json json_of(double value);
nlohmann::ordered_json json_of(const Estimate& estimate);
nlohmann::ordered_json json_of(const TestResult& test);

}  // namespace afm::study
