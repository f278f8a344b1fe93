// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "study/report_page.h"
#include "study/study_results.h"

namespace afm::study {

// Name of a condition in reports.
std::string condition_text(const std::string& condition);

// Section of the report on a lesson.
std::vector<PageBlock> lesson_blocks(const LessonResults& lesson);

// Figures with 95 % intervals.
std::string survey_svg(const std::vector<SurveyResult>& survey);
std::string identify_svg(const LessonResults& lesson);
std::string thresholds_svg(const LessonResults& lesson);

}  // namespace afm::study
