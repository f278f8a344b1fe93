// SPDX-License-Identifier: Apache-2.0
#include "study/study_report.h"

#include <fmt/format.h>

#include <cmath>

#include "core/written_by.h"
#include "study/age_band.h"
#include "study/survey_report.h"
#include "study_page.h"

namespace afm::study {

namespace {

constexpr const char* kStudyTitle = "A study with TouchAFM";

void append_blocks(std::vector<PageBlock>& page, std::vector<PageBlock> more) {
  for (PageBlock& block : more) page.push_back(std::move(block));
}

std::string ages_text(const StudyResults& results) {
  std::string text = "Ages in years:";
  std::size_t given = 0;
  for (const AgeBandRow& band : kAgeBands) {
    const auto found = results.ages.find(std::string(band.word));
    if (found == results.ages.end()) continue;
    given += found->second;
    text += fmt::format(" {}: {},", band.word, found->second);
  }
  return text + fmt::format(" not given: {}", results.people - given);
}

std::vector<PageBlock> people_blocks(const StudyResults& results) {
  std::vector<PageBlock> blocks{
      PageHeading{2, "Participants"},
      PageText{fmt::format("{} listed, {} with data that count; lessons: {}. Every interval is of 95 %. p is two-sided "
                           "unless the test says otherwise.",
                           results.listed, results.people, results.lessons.size())}};
  if (!results.ages.empty()) blocks.push_back(PageText{ages_text(results)});
  PageList list;
  for (const std::string& line : results.left_out) list.items.push_back("left out: " + line);
  for (const std::string& line : results.remarks) list.items.push_back(line);
  if (list.items.empty()) list.items.emplace_back("nobody was left out");
  blocks.push_back(std::move(list));
  return blocks;
}

std::vector<PageBlock> survey_blocks(const StudyResults& results) {
  std::vector<PageBlock> blocks{PageHeading{2, "The paper's survey (Table 3)"}};
  if (!results.survey.empty()) {
    PageTable table{{"Question", "n", "Mean here", "SD here", "Mean of the paper (n = 20)", "SD of the paper", "Test"},
                    {}};
    for (std::size_t i = 0; i < results.survey.size(); ++i) {
      const SurveyQuestion& question = survey_questions()[i];
      const SurveyResult& here = results.survey[i];
      const Summary printed = printed_summary(question);
      table.rows.push_back({fmt::format("{}. {}", i + 1, question.short_name), std::to_string(here.answers.n),
                            estimate_text({here.answers.n, here.answers.mean, here.interval}, 2),
                            number_text(here.answers.sd, 2),
                            estimate_text({printed.n, printed.mean, t_interval(printed)}, 2),
                            number_text(printed.sd, 2), test_text(here.against_paper)});
    }
    blocks.push_back(std::move(table));
    blocks.push_back(PageFigure{"table3.svg", survey_svg(results.survey),
                                "Mean answers with 95 % t intervals, here and in the paper."});
    PageList list;
    for (const TestResult& test : results.haptics_against_graphics) {
      list.items.push_back("haptics against graphics here, " + test_text(test));
    }
    list.items.push_back("Cronbach's alpha of the eight questions here: " + number_text(results.survey_alpha, 2));
    blocks.push_back(std::move(list));
  }
  append_blocks(blocks, {PageHeading{3, "Table 3: what it shows and what it does not"}});
  append_blocks(blocks, paper_survey_blocks());
  return blocks;
}

std::vector<PageBlock> method_blocks() {
  PageList list;
  list.items.emplace_back(
      "Shares: exact intervals of Clopper and Pearson. Trials of one person are taken as independent; the means by "
      "person do not depend on that.");
  list.items.emplace_back(
      "d' of a choice: of an observer without bias among as many materials as were shown or answered. d' against the "
      "rest: z(hits) - z(false alarms); c = -(z(hits) + z(false alarms))/2; log-linear: (count + 1/2)/(n + 1).");
  list.items.emplace_back(
      "Weber fraction: the level at which an observer without preference is right in 75 % of the trials; bias in the "
      "units of d'. Both are medians of the posterior distribution, with its quantiles.");
  list.items.emplace_back(
      "Means: Student's t; an interval ends where the scale of its values does. Conditions: paired where at least two "
      "people did both, otherwise Welch's t; d and d_z with "
      "intervals by the noncentral t. Holm's correction is for the number of tests reported side by side: a lesson's "
      "comparisons of conditions, over "
      "all of its measures; its identifications against chance; its changes; the scales of the SSQ; the questions of "
      "Table 3.");
  list.items.emplace_back(
      "SUS: Brooke 1996. NASA-TLX: the mean of the six ratings (Hart 2006). SSQ: Kennedy et al. 1993.");
  return {PageHeading{2, "Methods"}, std::move(list)};
}

}  // namespace

ReportFiles study_report(const StudyResults& results) {
  std::vector<PageBlock> page = people_blocks(results);
  for (const LessonResults& lesson : results.lessons) append_blocks(page, lesson_blocks(lesson));
  if (!std::isnan(results.sus_alpha)) {
    page.push_back(PageText{"Cronbach's alpha of the SUS: " + number_text(results.sus_alpha, 2)});
  }
  append_blocks(page, survey_blocks(results));
  append_blocks(page, method_blocks());
  page.push_back(PageText{"Computed by " + core::written_by() + "."});
  ReportFiles files{{"study.md", fmt::format("# {}\n\n", kStudyTitle) + page_markdown(page)},
                    {"study.html", page_html(kStudyTitle, page)},
                    {"study.json", study_json(results)}};
  for (const PageBlock& block : page) {
    if (const auto* figure = std::get_if<PageFigure>(&block)) files.emplace_back(figure->file, figure->svg);
  }
  return files;
}

}  // namespace afm::study
