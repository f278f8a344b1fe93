// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "study/study_data.h"
#include "study/study_report.h"
#include "study/study_results.h"
#include "study_writer.h"
#include "support/scratch_folder.h"

namespace afm::study {
namespace push_results_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kHeader =
    "onset\tduration\tstep\ttrial_type\tcondition\tpractice\ttrial\tlevel\tstimulus\tresponse\tcorrect\trt\tforce\t"
    "strokes\tlosses\tundos\twork\tlargest_force\taids\n";

std::string push(const std::string& step, const std::string& until, double response_m, double time_s, int losses,
                 const std::string& aids = "truth") {
  return fmt::format("1\t2\t{}\tpush\tn/a\t0\t1\tn/a\t{}\t{:.6g}\tn/a\t{}\t1\t3\t{}\t0\t40\t0.25\t{}\n", step, until,
                     response_m, time_s, losses, aids);
}

std::string with(std::string line, const std::string& old, const std::string& wrong) {
  return line.replace(line.find(old), old.size(), wrong);
}

TEST(PushTrials, AreReadWithTheirFiguresInSi) {
  const auto events = parse_events(kHeader + push("row", "pattern", 8e-9, 42, 2, "truth+undo"), "x.tsv");
  ASSERT_TRUE(events) << events.error().message;
  const StudyTrial& trial = events->trials.at(0);
  EXPECT_EQ(trial.kind, StepKind::Push);
  EXPECT_DOUBLE_EQ(trial.value.value(), 8e-9);
  EXPECT_DOUBLE_EQ(trial.strokes.value(), 3.0);
  EXPECT_DOUBLE_EQ(trial.losses.value(), 2.0);
  EXPECT_NEAR(trial.work_j.value(), 40e-18, 1e-27);
  EXPECT_NEAR(trial.largest_force_n.value(), 0.25e-9, 1e-18);
  EXPECT_EQ(trial.aids, "truth+undo");
}

TEST(PushTrials, AreRefusedByLineAndColumn) {
  const std::string line = push("row", "pattern", 8e-9, 42, 2);
  const auto fault = [](const std::string& bad) { return parse_events(kHeader + bad, "x.tsv").error().message; };
  EXPECT_THAT(fault(with(line, "pattern", "heap")), HasSubstr("x.tsv:2: stimulus \"heap\" is not moved"));
  EXPECT_THAT(fault(with(line, "8e-09", "8")), HasSubstr("x.tsv:2: response \"8\""));
  EXPECT_THAT(fault(with(line, "\t3\t2\t", "\t3\t1.5\t")), HasSubstr("losses \"1.5\" is not a whole number"));
  EXPECT_THAT(fault(with(line, "0.25", "-1")), HasSubstr("largest_force \"-1\""));
}

std::string written(const std::string& step, double response_m, int undos) {
  return fmt::format("1\t2\t{}\twrite\tn/a\t0\t1\tn/a\tn/a\t{:.6g}\tn/a\t30\t1\t2\t0\t{}\t4000\t21\ttruth\n", step,
                     response_m, undos);
}

TEST(WrittenLines, AreReadWithTheirFiguresInSiOrRefused) {
  const std::string line = written("letter", 2e-9, 1);
  const auto events = parse_events(kHeader + line, "x.tsv");
  ASSERT_TRUE(events) << events.error().message;
  const StudyTrial& trial = events->trials.at(0);
  EXPECT_EQ(trial.kind, StepKind::Write);
  EXPECT_DOUBLE_EQ(trial.value.value(), 2e-9);
  EXPECT_DOUBLE_EQ(trial.undos.value(), 1.0);
  EXPECT_NEAR(trial.work_j.value(), 4e-15, 1e-24);
  const auto fault = [](const std::string& bad) { return parse_events(kHeader + bad, "x.tsv").error().message; };
  EXPECT_THAT(fault(with(line, "n/a\t2e-09", "moved\t2e-09")), HasSubstr("stimulus \"moved\" is not empty"));
  EXPECT_THAT(fault(with(line, "2e-09", "2")), HasSubstr("response \"2\""));
}

TEST(WrittenLines, AreComparedBeforeAndAfterByPerson) {
  const support::ScratchFolder folder;
  test::StudyWriter writer(folder.path());
  for (std::size_t person = 0; person < 3; ++person) {
    const double off_m = 1e-9 * static_cast<double>(person);
    writer.add_bids_person(person,
                           kHeader + written("letter-before", 5e-9 + off_m, 2) + written("letter-after", 3e-9, 0));
  }
  const auto data = read_study(folder.path());
  ASSERT_TRUE(data) << data.error().message;
  const StudyResults results = study_results(*data);
  const LessonResults& lesson = results.lessons.at(0);
  EXPECT_EQ(lesson.pushes.counted, 0U);
  std::string keys;
  for (const Measure& each : lesson.measures) keys += each.key + " ";
  EXPECT_THAT(keys, AllOf(HasSubstr("off_m.letter"), HasSubstr("writing_time_s.letter"), HasSubstr("undos.letter")));
  EXPECT_NEAR(lesson.measures.at(0).values.at("before").at("sub-AAAAAC"), 7e-9, 1e-18);
  const auto compared = std::find_if(lesson.comparisons.begin(), lesson.comparisons.end(), [](const auto& each) {
    return each.measure == "letter, distance from the lines";
  });
  ASSERT_NE(compared, lesson.comparisons.end());
  EXPECT_LT(compared->test.effect.value, 0.0) << "nearer";
}

// Three people, nearer and 20 s faster after the lesson.
TEST(PushResults, CompareBeforeAndAfterByPerson) {
  const support::ScratchFolder folder;
  test::StudyWriter writer(folder.path());
  for (std::size_t person = 0; person < 3; ++person) {
    const double off = 1e-9 * static_cast<double>(person * person);
    writer.add_bids_person(person, kHeader + push("steer-before", "target", 20e-9 + 2.0 * off, 60, 2) +
                                       push("lose", "lost", 90e-9, 20, 1) +
                                       push("steer-after", "target", 10e-9 + off, 40, 0, "truth+undo"));
  }
  const auto data = read_study(folder.path());
  ASSERT_TRUE(data) << data.error().message;
  const StudyResults results = study_results(*data);
  const LessonResults& lesson = results.lessons.at(0);
  EXPECT_EQ(lesson.counted, 9U);
  EXPECT_EQ(lesson.pushes.counted, 9U);
  EXPECT_EQ(lesson.pushes.with_truth, 9U);
  EXPECT_EQ(lesson.pushes.with_undo, 3U);
  const auto measure = [&](const std::string& key) {
    for (const Measure& each : lesson.measures) {
      if (each.key == key) return each;
    }
    ADD_FAILURE() << key;
    return Measure{};
  };
  EXPECT_NEAR(measure("distance_m.steer").values.at("before").at("sub-AAAAAA"), 20e-9, 1e-18);
  EXPECT_NEAR(measure("distance_m.steer").values.at("after").at("sub-AAAAAC"), 14e-9, 1e-18);
  EXPECT_NEAR(measure("losses.steer").mean("before").value, 2.0, 1e-12);
  EXPECT_NEAR(measure("way_m.lose").values.at("").at("sub-AAAAAB"), 90e-9, 1e-18);
  bool compared = false;
  for (const ConditionComparison& each : lesson.comparisons) {
    if (each.measure != "steer, distance from the targets") continue;
    compared = true;
    EXPECT_EQ(each.a, "after");
    EXPECT_EQ(each.b, "before");
    EXPECT_EQ(each.test.effect.n, 3U);
    EXPECT_LT(each.test.effect.value, 0.0) << "nearer";
  }
  EXPECT_TRUE(compared);
  for (const auto& [name, text] : study_report(results)) {
    if (name == "study.md") {
      EXPECT_THAT(text, AllOf(HasSubstr("pushes of particles: 9; aids: the wall showed the particles in 9, pushes were "
                                        "taken back in 3"),
                              HasSubstr("steer, distance from the targets"), HasSubstr("work on the particles")));
    }
    if (name == "study.json") {
      EXPECT_EQ(nlohmann::json::parse(text)["lessons"][0]["pushes"]["with_undo"], 3);
    }
  }
}

}  // namespace push_results_test
}  // namespace afm::study
