// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "study/study_results.h"

namespace afm::study {

// The files of a report by name: study.md, study.html, study.json and the figures. They contain no time and no path, so
// that the same results give the same bytes.
using ReportFiles = std::vector<std::pair<std::string, std::string>>;
ReportFiles study_report(const StudyResults& results);

// study.json of a report.
std::string study_json(const StudyResults& results);

}  // namespace afm::study
