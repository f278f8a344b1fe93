// SPDX-License-Identifier: Apache-2.0
// Invariant: a report prints no p without effect size and interval, and the same bytes for the same data
#include "study/study_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>

#include "study/report_page.h"
#include "study/study_writer.h"
#include "study/survey_report.h"
#include "support/scratch_folder.h"

namespace afm::study {
namespace study_report_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class StudyReport : public ::testing::Test {
 protected:
  StudyResults results() const {
    const auto data = read_study(folder_.path());
    EXPECT_TRUE(data.has_value()) << (data ? "" : data.error().message);
    return study_results(data.value());
  }

  std::map<std::string, std::string> files() const {
    const ReportFiles list = study_report(results());
    return {list.begin(), list.end()};
  }

  void add_class(std::size_t people) {
    for (std::size_t i = 0; i < people; ++i) writer_.add_person(i, test::whole_lesson(static_cast<unsigned>(i + 1)));
  }

  support::ScratchFolder folder_;
  test::StudyWriter writer_{folder_.path()};
};

TEST_F(StudyReport, OfTheSameDataIsTheSameBytes) {
  add_class(8);
  const auto first = files();
  EXPECT_EQ(first, files());
  for (const char* name :
       {"study.md", "study.html", "study.json", "table3.svg", "identify-three.svg", "threshold-three.svg"}) {
    EXPECT_TRUE(first.contains(name)) << name;
  }
  EXPECT_THAT(first.at("study.md"), Not(HasSubstr(folder_.path())));
}

TEST_F(StudyReport, NamesBothAxesOfEveryPlot) {
  add_class(8);
  const auto all = files();
  EXPECT_THAT(all.at("table3.svg"), HasSubstr("mean answer, 0 to 4"));
  EXPECT_THAT(all.at("identify-three.svg"), HasSubstr("share right"));
  EXPECT_THAT(all.at("identify-three.svg"), HasSubstr("step and condition, in the order of the table"));
  EXPECT_THAT(all.at("threshold-three.svg"), HasSubstr("share right"));
}

TEST_F(StudyReport, PrintsNoPWithoutEffectSizeAndInterval) {
  add_class(8);
  const auto all = files();
  const std::regex adjusted(R"(; after Holm's correction p [=<] [0-9.]+)");
  const std::regex any(R"(\bp [=<] )"), whole(R"(\bp [=<] [0-9.]+; [^=]* = -?[0-9.∞]+ \[-?[0-9.∞]+, -?[0-9.∞]+\])");
  for (const char* name : {"study.md", "study.html"}) {
    const std::string& text = all.at(name);
    const std::string marked =
        std::regex_replace(std::regex_replace(text, std::regex("p &lt; "), "p < "), adjusted, "");
    const auto count = [&](const std::regex& pattern) {
      return std::distance(std::sregex_iterator(marked.begin(), marked.end(), pattern), std::sregex_iterator());
    };
    EXPECT_GT(count(any), 10) << name;
    EXPECT_EQ(count(any), count(whole)) << name;
  }
  // in JSON a p lies in an object with its effect
  const std::function<void(const Json&)> check = [&](const Json& json) {
    if (json.is_object() && json.contains("p")) {
      EXPECT_TRUE(json.contains("effect_size") && json["effect_size"].contains("low")) << json.dump();
    }
    if (json.is_structured()) {
      for (const auto& each : json) check(each);
    }
  };
  check(Json::parse(all.at("study.json")));
}

TEST_F(StudyReport, KeepsPracticeAndUnansweredTrialsApart) {
  test::SimulatedEvents events(1);
  events.identify("haptics", 1.0, 10);
  events.line("blind", "identify", "haptics", false, 11, "n/a", "mica", "n/a", "n/a");
  writer_.add_person(0, events.text());
  const LessonResults lesson = results().lessons.at(0);
  EXPECT_EQ(lesson.practice, 3U);
  EXPECT_EQ(lesson.unanswered, 1U);
  EXPECT_EQ(lesson.counted, 10U);
  ASSERT_EQ(lesson.identify.size(), 1U);
  EXPECT_EQ(lesson.identify[0].matrix.trials(), 10U);
  EXPECT_THAT(files().at("study.md"),
              HasSubstr("10 counted, 3 of practice (left out), 1 without an answer (left out)"));
}

// Two people felt everything, one nothing; the feeling of a fourth is unknown.
TEST_F(StudyReport, LeavesOutAndCountsWhatWasNotFelt) {
  const auto events = [](unsigned seed, const char* condition) {
    test::SimulatedEvents made(seed);
    made.identify(condition, 1.0, 10);
    return made.text();
  };
  writer_.add_bids_person(0, test::with_force(events(1, "haptics"), "1"));
  writer_.add_bids_person(1, test::with_force(events(2, "picture"), "0"));
  writer_.add_bids_person(2, test::with_force(events(3, "haptics"), "0"));
  writer_.add_person(3, events(4, "haptics"));
  const LessonResults lesson = results().lessons.at(0);
  EXPECT_EQ(lesson.people, 4U) << "both layouts are one lesson";
  EXPECT_EQ(lesson.counted, 30U);
  EXPECT_EQ(lesson.not_felt, 10U);
  EXPECT_EQ(lesson.force_unknown, 10U);
  ASSERT_EQ(lesson.identify.size(), 2U);
  EXPECT_EQ(lesson.identify[0].condition, "haptics");
  EXPECT_EQ(lesson.identify[0].matrix.trials(), 20U);
  EXPECT_EQ(lesson.identify[1].matrix.trials(), 10U);
  const auto all = files();
  for (const char* name : {"study.md", "study.html"}) {
    EXPECT_THAT(all.at(name), HasSubstr("10 in which the force was not as the step sets it (left out)"));
    EXPECT_THAT(all.at(name), HasSubstr("force on the hand: not known for 10 of the counted trials")) << name;
  }
  const auto json = Json::parse(all.at("study.json"))["lessons"][0]["trials"];
  EXPECT_EQ(json["not_felt"], 10);
  EXPECT_EQ(json["force_unknown"], 10);
}

TEST_F(StudyReport, PoolsTheNamesOfBothLayouts) {
  test::SimulatedEvents events(1);
  events.identify("haptics", 1.0, 4);
  writer_.add_person(0, events.text(), "finished", "thr-ee");
  writer_.add_bids_person(1, test::with_force(events.text(), "1"));
  const StudyResults study = results();
  ASSERT_EQ(study.lessons.size(), 1U);
  EXPECT_EQ(study.lessons[0].task, "three");
}

// Shares right and times to answer are compared side by side: four tests are no two.
TEST_F(StudyReport, CorrectsForAllTestsThatStandSideBySide) {
  add_class(8);
  const auto study = Json::parse(files().at("study.json"));
  const auto& lesson = study["lessons"][0];
  const auto& comparisons = lesson["comparisons"];
  ASSERT_EQ(comparisons.size(), 2U) << "share right and time to answer, haptics against picture";
  const double shares = comparisons[0]["test"]["p"];
  EXPECT_TRUE(comparisons[1]["test"]["p"].is_null()) << "all times are the same, so one test is left";
  EXPECT_TRUE(comparisons[0]["p_holm"].is_null()) << shares;
  const auto& identify = lesson["identify"];
  ASSERT_EQ(identify.size(), 2U);
  const double first = identify[0]["against_chance"]["p"], second = identify[1]["against_chance"]["p"];
  const double corrected_first = identify[0]["against_chance"]["p_holm"];
  EXPECT_NEAR(corrected_first,
              first < second ? std::min(1.0, 2.0 * first) : std::max(first, std::min(1.0, 2.0 * second)), 1e-12);
  for (const auto& each : lesson["ssq"]) EXPECT_TRUE(each["change"].contains("p_holm")) << each.dump();
  ASSERT_EQ(study["survey"].size(), 8U);
  for (const auto& each : study["survey"]) {
    const auto& test = each["against_paper"];
    ASSERT_EQ(test.contains("p_holm"), !test["p"].is_null());
    if (test.contains("p_holm")) {
      EXPECT_GE(test["p_holm"].get<double>(), test["p"].get<double>());
    }
  }
  EXPECT_THAT(files().at("study.md"), HasSubstr("a lesson's comparisons of conditions, over all of its measures"));
}

TEST_F(StudyReport, HasTheConfusionMatrixOfTheTrials) {  // rows E16 to E19
  test::SimulatedEvents events(1);
  const std::vector<std::string> names{"mica", "gold", "si3n4"};
  const int counts[3][3] = {{14, 4, 2}, {3, 12, 5}, {1, 6, 13}};
  int trial = 0;
  for (std::size_t shown = 0; shown < 3; ++shown) {
    for (std::size_t answered = 0; answered < 3; ++answered) {
      for (int i = 0; i < counts[shown][answered]; ++i) {
        events.line("blind", "identify", "n/a", false, ++trial, "n/a", names[shown], names[answered],
                    shown == answered ? "1" : "0");
      }
    }
  }
  writer_.add_person(0, events.text());
  const auto json = Json::parse(files().at("study.json"))["lessons"][0]["identify"][0];
  EXPECT_EQ(json["materials"], (std::vector<std::string>{"gold", "mica", "si3n4"}));
  EXPECT_EQ(json["confusion_shown_answered"][0], (std::vector<int>{12, 3, 5}));
  EXPECT_NEAR(json["accuracy"]["value"], 0.65, 1e-12);
  EXPECT_NEAR(json["kappa"], 0.475, 1e-9);
  EXPECT_NEAR(json["information_bits"], 0.3632596791, 1e-9);
  EXPECT_NEAR(json["by_material"][0]["against_the_rest"]["d_prime"], 0.9278368533, 1e-9);
  EXPECT_NEAR(json["by_material"][0]["against_the_rest"]["criterion"], 0.2105713235, 1e-9);
}

TEST_F(StudyReport, CountsTheMaterialsOfAStepUnderAllConditions) {
  test::SimulatedEvents events(1);
  events.line("blind", "identify", "haptics", false, 1, "n/a", "mica", "mica", "1");
  events.line("blind", "identify", "picture", false, 1, "n/a", "gold", "si3n4", "0");
  writer_.add_person(0, events.text(), "stopped");
  const StudyResults study = results();
  EXPECT_NEAR(study.lessons.at(0).identify.at(0).chance, 1.0 / 3.0, 1e-12);
  EXPECT_THAT(study.remarks, ::testing::ElementsAre("sub-AAAAAA: stopped; the trials until then count"));
}

TEST_F(StudyReport, FindsTheAbilitiesThatItsPeopleWereGiven) {
  for (std::size_t i = 0; i < 20; ++i) {
    test::SimulatedEvents events(static_cast<unsigned>(100 + i));
    events.identify("haptics", 0.8, 40);
    events.identify("picture", 0.5, 40);
    events.threshold(0.1, 0.5, 40);
    writer_.add_person(i, events.text());
  }
  const LessonResults lesson = results().lessons.at(0);
  ASSERT_EQ(lesson.identify.size(), 2U);
  EXPECT_TRUE(lesson.identify[0].accuracy.interval.holds(0.8));
  EXPECT_TRUE(lesson.identify[1].accuracy.interval.holds(0.5));
  ASSERT_EQ(lesson.thresholds.size(), 1U);
  int weber = 0, bias = 0;
  for (const ThresholdResult::Person& person : lesson.thresholds[0].people) {
    weber += person.fit.weber_fraction.interval.holds(0.1) ? 1 : 0;
    bias += person.fit.bias.interval.holds(0.5) ? 1 : 0;
  }
  EXPECT_GE(weber, 18);
  EXPECT_GE(bias, 18);
  EXPECT_TRUE(lesson.thresholds[0].weber_fraction.interval.holds(0.1));
  ASSERT_FALSE(lesson.comparisons.empty());
  const ConditionComparison& first = lesson.comparisons.front();
  EXPECT_EQ(first.measure, "blind, share right");
  EXPECT_THAT(first.test.name, HasSubstr("paired t"));
  EXPECT_GT(first.test.effect.interval.low, 1.0) << "0.3 more right answers with an SD of a tenth";
}

TEST_F(StudyReport, KeepsEveryIntervalWithinTheScaleOfItsValues) {
  for (std::size_t i = 0; i < 4; ++i) {
    test::SimulatedEvents events(static_cast<unsigned>(i + 1));
    const bool best = i > 0;  // three of four people are perfect, so that t by itself would exceed the scale
    for (const char* step : {"blind-before", "blind-after"}) {
      for (int trial = 1; trial <= 4; ++trial) {
        const bool right = best || trial < 3;
        events.line(step, "identify", "n/a", false, trial, "n/a", "mica", right ? "mica" : "gold", right ? "1" : "0");
      }
    }
    events.line("sketch", "draw", "n/a", false, 1, "n/a", "n/a", best ? "0" : "0.8", "n/a");
    events.questions("load", "tlx", 6, best ? 100 : 60, best ? 100 : 60);
    events.questions("survey", "paper", 8, best ? 4 : 1, best ? 4 : 1);
    events.questions("ssq-before", "ssq", 16, best ? 0 : 1, best ? 0 : 1);
    events.questions("ssq-after", "ssq", 16, 0, 0);
    writer_.add_person(i, events.text());
  }
  const StudyResults study = results();
  const LessonResults& lesson = study.lessons.at(0);
  std::map<std::string, Interval> mean;
  for (const Measure& measure : lesson.measures) mean[measure.key] = measure.mean("").interval;
  EXPECT_DOUBLE_EQ(mean.at("right.blind-before").high, 1.0);
  EXPECT_GT(mean.at("right.blind-before").low, 0.0) << "an end that can be is as t has it";
  EXPECT_DOUBLE_EQ(mean.at("drawing.sketch").low, 0.0);
  EXPECT_DOUBLE_EQ(mean.at("tlx").high, 100.0);
  EXPECT_DOUBLE_EQ(lesson.learning.at(0).before.interval.high, 1.0);
  EXPECT_DOUBLE_EQ(lesson.ssq.at(3).before.interval.low, 0.0);
  EXPECT_DOUBLE_EQ(study.survey.at(0).interval.high, 4.0);
}

TEST_F(StudyReport, CountsAgesAndSaysWhoseSoundWasLost) {
  test::SimulatedEvents events(1);
  events.identify("sound", 0.8, 4);
  writer_.add_person(0, events.text());
  writer_.add_person(1, events.text());
  test::StudyWriter::write(folder_.file("sub-AAAAAB/task-three_events.json"), R"({"Lesson": {"sound_lost_s": 61.7}})");
  const std::string people = folder_.file("participants.tsv");
  test::StudyWriter::write(
      people, std::string(test::kPeopleHeader) + "sub-AAAAAA\t0\t14-17\tfinished\nsub-AAAAAB\t1\tn/a\tfinished\n");
  const auto all = files();
  EXPECT_THAT(all.at("study.md"), AllOf(HasSubstr("Ages in years: 14-17: 1, not given: 1"),
                                        HasSubstr("sub-AAAAAB/task-three_events.json: without sound from 62 s on")));
  EXPECT_EQ(Json::parse(all.at("study.json"))["ages"]["14-17"], 1);
}

TEST_F(StudyReport, ComparesDifferentPeopleByWelch) {
  for (std::size_t i = 0; i < 8; ++i) {
    test::SimulatedEvents events(static_cast<unsigned>(i + 1));
    events.identify(i % 2 == 0 ? "haptics" : "picture", i % 2 == 0 ? 0.9 : 0.3, 20);
    writer_.add_person(i, events.text());
  }
  const auto comparisons = results().lessons.at(0).comparisons;
  ASSERT_FALSE(comparisons.empty());
  EXPECT_EQ(comparisons[0].test.name, "Welch t");
  EXPECT_LT(comparisons[0].test.p, 0.05);
}

TEST_F(StudyReport, ScoresQuestionnairesAndNamesThoseThatAreNotComplete) {
  const auto answered = [](const std::vector<int>& sus) {
    test::SimulatedEvents events(1);
    for (std::size_t i = 0; i < sus.size(); ++i) {
      events.line("usability", "question", "n/a", false, 1, "n/a", "sus-" + std::to_string(i + 1),
                  std::to_string(sus[i]), "n/a");
    }
    return events.text();
  };
  writer_.add_person(0, answered({4, 2, 5, 1, 4, 2, 4, 1, 5, 2}));  // row E06
  writer_.add_person(1, answered({3, 3, 3, 3, 3, 3, 3, 3, 3, 3}));
  writer_.add_person(2, answered({3, 3, 3}));
  const LessonResults lesson = results().lessons.at(0);
  ASSERT_EQ(lesson.measures.size(), 1U);
  EXPECT_DOUBLE_EQ(lesson.measures[0].mean("").value, 67.5);
  EXPECT_THAT(lesson.left_out, ::testing::ElementsAre("sub-AAAAAC: SUS is not complete"));
  EXPECT_THAT(files().at("study.md"), HasSubstr("| SUS | no condition | 2 | 67.5 ["));
}

TEST_F(StudyReport, ComparesTheSicknessBeforeAndAfter) {
  const auto sick = [](int before, int after) {
    test::SimulatedEvents events(1);
    events.questions("ssq-before", "ssq", 16, before, before);
    events.questions("ssq-after", "ssq", 16, after, after);
    return events.text();
  };
  writer_.add_person(0, sick(0, 1));
  writer_.add_person(1, sick(0, 0));
  writer_.add_person(2, sick(0, 1));
  const LessonResults lesson = results().lessons.at(0);
  ASSERT_EQ(lesson.ssq.size(), 4U);
  EXPECT_EQ(lesson.ssq[3].scale, "total");
  EXPECT_NEAR(lesson.ssq[3].before.value, 0.0, 1e-12);
  EXPECT_NEAR(lesson.ssq[3].after.value, 2.0 / 3.0 * 78.54, 1e-9);  // row E09
  EXPECT_EQ(lesson.ssq_stops, 2U);
}

TEST_F(StudyReport, MeasuresWhatWasLearned) {
  for (std::size_t i = 0; i < 6; ++i) {
    test::SimulatedEvents events(static_cast<unsigned>(i + 1));
    for (int trial = 1; trial <= 10; ++trial) {
      const bool pre = trial <= 4 + static_cast<int>(i % 2), post = trial <= 7;
      events.line("test-before", "identify", "n/a", false, trial, "n/a", "mica", pre ? "mica" : "gold",
                  pre ? "1" : "0");
      events.line("test-after", "identify", "n/a", false, trial, "n/a", "mica", post ? "mica" : "gold",
                  post ? "1" : "0");
    }
    writer_.add_person(i, events.text());
  }
  const auto learning = results().lessons.at(0).learning;
  ASSERT_EQ(learning.size(), 1U);
  EXPECT_EQ(learning[0].step, "test");
  EXPECT_NEAR(learning[0].gain, (0.7 - 0.45) / 0.55, 1e-12);
  EXPECT_EQ(learning[0].single_trials.statistic, "15 up, 0 down");
  EXPECT_LT(learning[0].change.p, 0.01);
}

TEST_F(StudyReport, ComparesWithThePapersTable) {
  add_class(4);
  const auto all = files();
  EXPECT_THAT(all.at("study.md"),
              AllOf(HasSubstr("3.35 [2.97, 3.73]"), HasSubstr("p = 0.42; d = 0.26"), HasSubstr("all 899"),
                    HasSubstr("p = 0.042; d_z = "), HasSubstr("p = 0.065"), HasSubstr("Table 3 is consistent")));
  const auto json = Json::parse(all.at("study.json"));
  EXPECT_EQ(json["survey"].size(), 8U);
  EXPECT_EQ(json["participants"], 4);
  EXPECT_FALSE(json["paper_table3"]["haptics_more_helpful_than_graphics_follows"].get<bool>());
}

TEST_F(StudyReport, OfOnePersonWithOneTrialHasNoIntervalsOfMeans) {
  test::SimulatedEvents events(1);
  events.line("harder", "threshold", "n/a", false, 1, "0.1", "first", "first", "1");
  events.line("blind", "identify", "n/a", false, 1, "n/a", "mica", "mica", "1");
  events.line("survey", "question", "n/a", false, 1, "n/a", "paper-4", "3", "n/a");
  writer_.add_person(0, events.text());
  const auto all = files();
  EXPECT_THAT(all.at("study.md"), AllOf(HasSubstr("1 of 1"), HasSubstr("n/a"), Not(HasSubstr("nan "))));
  EXPECT_TRUE(Json::accept(all.at("study.json")));
}

TEST_F(StudyReport, OfPeopleWithoutTrialsSaysSo) {
  writer_.add_person(0, "");
  EXPECT_THAT(files().at("study.md"), HasSubstr("0 counted"));
}

TEST(ReportPage, KeepsMarkupOfTextsOutOfHtmlAndTables) {
  const std::vector<PageBlock> blocks{PageText{"a < b & c"}, PageTable{{"x"}, {{"a|b"}}}};
  EXPECT_THAT(page_html("<t>", blocks), AllOf(HasSubstr("&lt;t>"), HasSubstr("a &lt; b &amp; c")));
  EXPECT_THAT(page_markdown(blocks), HasSubstr("| a\\|b |"));
}

TEST(ReportPage, WritesNumbersAsPeopleDo) {
  EXPECT_EQ(number_text(-0.001, 2), "0.00");
  EXPECT_EQ(number_text(std::nan(""), 2), "n/a");
  EXPECT_EQ(estimate_text({3, 0.1, {0.0, std::numeric_limits<double>::infinity()}}, 2), "0.10 [0.00, ∞]");
  EXPECT_EQ(test_text({"t", "t(3) = 9", 0.0004, "d", {4, 2.0, {1.0, 3.0}}}),
            "t: t(3) = 9, p < 0.001; d = 2.00 [1.00, 3.00]");
}

}  // namespace study_report_test
}  // namespace afm::study
