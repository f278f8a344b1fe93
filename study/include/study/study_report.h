// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/study_results.h"

namespace afm::study {

// The files of a report by their names: study.md, study.html, study.json and the figures. No clock and no path is in
// them: the same results give the same bytes.
using ReportFiles = std::vector<std::pair<std::string, std::string>>;
ReportFiles study_report(const StudyResults& results);

}  // namespace afm::study
