// SPDX-License-Identifier: Apache-2.0
// Invariant: a study's files are read as their columns say, or refused in one line with file and line
#include "study/study_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "study/study_writer.h"
#include "support/scratch_folder.h"

namespace afm::study {
namespace study_data_test {

using test::event_line;
using test::kEventsHeader;
using test::kPeopleHeader;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string identified(const std::string& shown, const std::string& answered, const std::string& correct) {
  return event_line(1, "blind", "identify", "haptics", false, 1, "n/a", shown, answered, correct);
}

std::string fault_of(const std::string& bytes) {
  const auto events = parse_events(bytes, "x.tsv");
  if (events) return "";
  EXPECT_EQ(events.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(events.error().message.find('\n'), std::string::npos);
  return events.error().message;
}

TEST(StudyEvents, AreReadAsTheyWereWritten) {
  const auto events =
      parse_events(kEventsHeader + identified("mica", "gold", "0") +
                       event_line(4, "harder", "threshold", "n/a", true, 2, "0.25", "second", "second", "1") +
                       event_line(6, "usability", "question", "n/a", false, 3, "n/a", "sus-3", "4", "n/a") +
                       event_line(8, "cycle", "cycle", "n/a", false, 1, "n/a", "n/a", "1.4e-09", "n/a"),
                   "x.tsv");
  ASSERT_TRUE(events.has_value()) << events.error().message;
  ASSERT_EQ(events->trials.size(), 4U);
  EXPECT_EQ(events->cut_line, 0U);
  const StudyTrial& first = events->trials[0];
  EXPECT_EQ(first.kind, StepKind::Identify);
  EXPECT_EQ(first.condition, "haptics");
  EXPECT_EQ(first.stimulus, "mica");
  EXPECT_EQ(first.response, "gold");
  EXPECT_EQ(first.right, false);
  EXPECT_DOUBLE_EQ(first.rt_s.value(), 0.8);
  EXPECT_TRUE(events->trials[1].practice);
  EXPECT_EQ(events->trials[1].condition, "");
  EXPECT_DOUBLE_EQ(events->trials[1].level.value(), 0.25);
  EXPECT_EQ(events->trials[1].right, true);
  EXPECT_DOUBLE_EQ(events->trials[2].value.value(), 4.0);
  EXPECT_FALSE(events->trials[2].right.has_value());
  EXPECT_DOUBLE_EQ(events->trials[3].value.value(), 1.4e-9);
}

TEST(StudyEvents, MayHaveTheirColumnsInAnyOrder) {
  const auto events = parse_events(
      "step\tonset\tduration\ttrial_type\tcondition\tpractice\ttrial\tlevel\tstimulus\tresponse\tcorrect\trt\n"
      "end\t3\t1\ttext\tn/a\t0\t1\tn/a\tn/a\tn/a\tn/a\tn/a\n",
      "x.tsv");
  ASSERT_TRUE(events.has_value()) << events.error().message;
  EXPECT_EQ(events->trials[0].step, "end");
  EXPECT_DOUBLE_EQ(events->trials[0].onset_s, 3.0);
}

TEST(StudyEvents, LoseTheLastLineThatAKilledProgramCut) {
  const std::string whole = kEventsHeader + identified("mica", "gold", "0");
  const std::string last = identified("gold", "gold", "1");
  for (std::size_t length = 1; length < last.size(); ++length) {
    const auto events = parse_events(whole + last.substr(0, length), "x.tsv");
    ASSERT_TRUE(events.has_value()) << length;
    EXPECT_EQ(events->trials.size(), 1U);
    EXPECT_EQ(events->cut_line, 3U);
  }
  EXPECT_EQ(parse_events(whole + last, "x.tsv")->cut_line, 0U);
}

TEST(StudyEvents, RefuseWrongColumnsByName) {
  std::string header = kEventsHeader;
  EXPECT_THAT(fault_of(""), HasSubstr("x.tsv:1: there is no header line"));
  EXPECT_THAT(fault_of("onset\tduration\n"), HasSubstr("x.tsv:1: there is no column \"step\""));
  EXPECT_THAT(fault_of("mood\t" + header), HasSubstr("x.tsv:1: unknown column \"mood\""));
  EXPECT_THAT(fault_of("rt\t" + header), HasSubstr("the column \"rt\" is there twice"));
  EXPECT_THAT(fault_of("force\t" + header.substr(0, header.size() - 1) + "\tforce\n"),
              HasSubstr("\"force\" is there twice"));
  EXPECT_THAT(fault_of(header + "1\t2\n"), HasSubstr("x.tsv:2: 2 fields instead of 12"));
}

// Excel and LibreOffice write these; a tab-separated text of a spreadsheet may as well be UTF-16, which is named.
TEST(StudyEvents, AreReadFromASpreadsheetsFile) {
  const std::string plain = kEventsHeader + identified("mica", "gold", "0") + identified("gold", "gold", "1");
  std::string windows;
  for (const char c : plain) windows += c == '\n' ? "\r\n" : std::string(1, c);
  std::string quoted = "\"";
  for (const char c : plain) quoted += c == '\t' ? "\"\t\"" : c == '\n' ? "\"\n\"" : std::string(1, c);
  quoted.pop_back();
  for (const std::string& bytes :
       {windows, "\xEF\xBB\xBF" + plain, "\xEF\xBB\xBF" + windows, plain + "\n\r\n", quoted}) {
    const auto events = parse_events(bytes, "x.tsv");
    ASSERT_TRUE(events.has_value()) << events.error().message;
    ASSERT_EQ(events->trials.size(), 2U);
    EXPECT_EQ(events->trials[0].response, "gold");
    EXPECT_DOUBLE_EQ(events->trials[0].rt_s.value(), 0.8);
    EXPECT_EQ(events->cut_line, 0U);
  }
  for (const char* mark : {"\xFF\xFE", "\xFE\xFF"}) {
    EXPECT_THAT(fault_of(mark + plain), HasSubstr("x.tsv:1: the text is UTF-16; save it as UTF-8"));
  }
}

TEST(StudyEvents, SayWhetherTheForceWasOnOrThatItIsNotKnown) {
  std::string header = kEventsHeader, line = identified("mica", "gold", "0");
  header.insert(header.size() - 1, "\tforce");
  for (const auto& [said, force] :
       {std::pair<const char*, std::optional<bool>>{"0", false}, {"1", true}, {"n/a", std::nullopt}}) {
    std::string with = line;
    with.insert(with.size() - 1, std::string("\t") + said);
    const auto events = parse_events(header + with, "x.tsv");
    ASSERT_TRUE(events.has_value()) << events.error().message;
    EXPECT_EQ(events->trials.at(0).force, force);
    EXPECT_EQ(events->trials.at(0).felt_as_set(), force) << "its condition is haptics";
  }
  EXPECT_FALSE(parse_events(kEventsHeader + line, "x.tsv")->trials.at(0).force) << "no such column";
  EXPECT_THAT(fault_of(header + line), HasSubstr("x.tsv:2: 12 fields instead of 13"));
  line.insert(line.size() - 1, "\t0.5");
  EXPECT_THAT(fault_of(header + line), HasSubstr("force \"0.5\" is not 0 or 1"));
  StudyTrial seen;
  seen.condition = "picture";
  seen.force = false;
  EXPECT_EQ(seen.felt_as_set(), true);
  seen.force = true;
  EXPECT_EQ(seen.felt_as_set(), false);
}

TEST(StudyEvents, RefuseEveryValueThatItsColumnDoesNotTake) {
  const std::string good = "1\t1\tblind\tidentify\thaptics\t0\t1\tn/a\tmica\tmica\t1\t0.5\n";
  ASSERT_EQ(fault_of(kEventsHeader + good), "");
  struct Row {
    const char *from, *to, *fault;
  };
  for (const Row& row :
       {Row{"1\t1\tblind", "x\t1\tblind", "onset \"x\" is not a number"}, Row{"1\t1\tblind", "-1\t1\tblind", "onset"},
        Row{"1\t1\tblind", "1\tnan\tblind", "duration \"nan\""},
        Row{"1\t1\tblind", "1\tinf\tblind", "duration \"inf\""}, Row{"1\t1\tblind", "1\t1 \tblind", "duration \"1 \""},
        Row{"\tblind\t", "\tn/a\t", "step"}, Row{"\tblind\t", "\tbl ind\t", "step \"bl ind\" is not one word"},
        Row{"\tidentify\t", "\tguess\t", "trial_type \"guess\" is not text, free"},
        Row{"haptics\t0", "haptics\t2", "practice"}, Row{"haptics\t0", "haptics\t0.5", "practice"},
        Row{"haptics\t0", "haptics\tn/a", "practice"},
        Row{"0\t1\tn/a", "0\t0\tn/a", "trial \"0\" is not a whole number from 1"},
        Row{"0\t1\tn/a", "0\t1\t-0.1", "level"}, Row{"\tmica\tmica", "\tn/a\tmica", "stimulus"},
        Row{"\tmica\tmica", "\tmica\tgold", "correct \"1\" is not what stimulus and response say"},
        Row{"mica\t1\t0.5", "mica\t0.5\t0.5", "correct"}, Row{"mica\t1\t0.5", "mica\t1\t-2", "rt"}}) {
    std::string line = good;
    line.replace(line.find(row.from), std::string(row.from).size(), row.to);
    EXPECT_THAT(fault_of(kEventsHeader + good + line), AllOf(HasSubstr("x.tsv:3: "), HasSubstr(row.fault))) << line;
  }
}

TEST(StudyEvents, RefuseAnswersOutsideTheirQuestionnaire) {
  const auto asked = [](const std::string& item, const std::string& answer) {
    return kEventsHeader + event_line(1, "q", "question", "n/a", false, 1, "n/a", item, answer, "n/a");
  };
  for (const auto& [item, answer] :
       {std::pair{"paper-8", "4"}, {"sus-10", "1"}, {"tlx-6", "100"}, {"ssq-16", "0"}, {"ssq-1", "n/a"}}) {
    EXPECT_EQ(fault_of(asked(item, answer)), "") << item;
  }
  for (const auto& [item, answer] :
       {std::pair{"paper-8", "5"}, {"sus-10", "0"}, {"tlx-6", "101"}, {"ssq-16", "-1"}, {"ssq-1", "1.5"}}) {
    EXPECT_THAT(fault_of(asked(item, answer)), HasSubstr("response")) << item;
  }
  for (const char* item : {"paper-9", "sus-0", "tlx-", "ssq-1.5", "mood-1", "n/a"}) {
    EXPECT_THAT(fault_of(asked(item, "1")), HasSubstr("an item of a questionnaire")) << item;
  }
  EXPECT_THAT(fault_of(kEventsHeader + event_line(1, "s", "draw", "n/a", false, 1, "n/a", "n/a", "1.2", "n/a")),
              HasSubstr("response"));
  EXPECT_THAT(fault_of(kEventsHeader + event_line(1, "s", "threshold", "n/a", false, 1, "n/a", "first", "first", "1")),
              HasSubstr("level"));
  EXPECT_THAT(fault_of(kEventsHeader + event_line(1, "s", "threshold", "n/a", false, 1, "0.1", "first", "third", "0")),
              HasSubstr("first or second"));
}

TEST(StudyEvents, HaveALimit) {
  const std::string line = "1\t1\tend\ttext\tn/a\t0\t1\tn/a\tn/a\tn/a\tn/a\tn/a\n";
  std::string bytes = kEventsHeader;
  for (int i = 1; i < 100'000; ++i) bytes += line;
  EXPECT_EQ(fault_of(bytes), "");
  EXPECT_THAT(fault_of(bytes + line), HasSubstr("x.tsv:100001: more than 100000 lines"));
}

TEST(StudyPeople, AreReadOrRefusedByLine) {
  const auto people =
      parse_people(kPeopleHeader + std::string("sub-ABCDEF\t0\tn/a\tfinished\nsub-GHIJKL\t1\t18-24"), "p");
  ASSERT_TRUE(people.has_value());
  ASSERT_EQ(people->people.size(), 1U);
  EXPECT_EQ(people->people[0].id, "sub-ABCDEF");
  EXPECT_EQ(people->people[0].age_band, "");
  EXPECT_EQ(people->cut_line, 3U);
  for (const char* line : {"sub-abcdef\t0\tn/a\tn/a\n", "sub-../../x\t0\tn/a\tn/a\n", "sub-ABCDEF\tx\tn/a\tn/a\n",
                           "sub-ABCDEF\t0\tn/a\tbored\n", "sub-ABCDEF\t0\t37\tn/a\n", "sub-ABCDEF\t0\tn/a\n"}) {
    const auto refused = parse_people(std::string(kPeopleHeader) + line, "p");
    ASSERT_FALSE(refused.has_value()) << line;
    EXPECT_THAT(refused.error().message, HasSubstr("p:2: "));
  }
  const std::string one = "sub-ABCDEF\t0\tn/a\tn/a\n";
  EXPECT_THAT(parse_people(kPeopleHeader + one + one, "p").error().message, HasSubstr("p:3: this participant"));
}

TEST(LessonFacts, SayWhenTheSoundWasLost) {
  EXPECT_EQ(parse_lesson_facts(R"({"Lesson": {"sound_lost_s": 12.5}})", "x")->sound_lost_s, 12.5);
  for (const char* wrong : {"-1", "\"12\"", "null", "true", "[1]"}) {
    const auto refused = parse_lesson_facts(std::string(R"({"Lesson": {"sound_lost_s": )") + wrong + "}}", "x.json");
    ASSERT_FALSE(refused.has_value()) << wrong;
    EXPECT_THAT(refused.error().message, HasSubstr("x.json: sound_lost_s is not a number from 0"));
  }
}

TEST(LessonFacts, TakeTheEnglishTitle) {
  const auto facts = parse_lesson_facts(test::facts_json("omni"), "x.json");
  ASSERT_TRUE(facts.has_value());
  EXPECT_EQ(facts->title, "Three materials");
  EXPECT_EQ(facts->device, "omni");
  EXPECT_TRUE(facts->simulated);
  EXPECT_FALSE(facts->sound_lost_s);
  EXPECT_FALSE(parse_lesson_facts("{", "x").has_value());
  EXPECT_FALSE(parse_lesson_facts("[]", "x").has_value());
  EXPECT_FALSE(parse_lesson_facts("{\"Lesson\": 3}", "x").has_value());
  EXPECT_FALSE(parse_lesson_facts(std::string(200'000, '['), "x").has_value());
}

class StudyFolder : public ::testing::Test {
 protected:
  std::string message() const {
    const auto data = read_study(folder_.path());
    EXPECT_FALSE(data.has_value());
    if (data) return "";
    EXPECT_EQ(data.error().category, core::ErrorCategory::BadInputFile);
    return data.error().message;
  }

  support::ScratchFolder folder_;
  test::StudyWriter writer_{folder_.path()};
};

TEST_F(StudyFolder, WithoutParticipantsIsRefused) {
  EXPECT_THAT(message(), HasSubstr("no participants.tsv is in it"));
  folder_.write("participants.tsv", kPeopleHeader);
  EXPECT_THAT(message(), HasSubstr("it names no participant"));
  EXPECT_THAT(read_study(folder_.file("nowhere")).error().message, HasSubstr("there is no such folder"));
}

TEST_F(StudyFolder, NamesEveryoneWhoIsLeftOutAndWhy) {
  writer_.add_person(0, identified("mica", "mica", "1"));
  writer_.add_person(1, identified("mica", "mica", "1"), "withdrew");
  writer_.add_person(2, identified("mica", "mica", "1"), "stopped");
  std::filesystem::remove_all(folder_.file(test::StudyWriter::code(2)));
  std::filesystem::create_directories(folder_.file("sub-STRAY"));
  const auto data = read_study(folder_.path());
  ASSERT_TRUE(data.has_value()) << data.error().message;
  EXPECT_EQ(data->listed, 3U);
  ASSERT_EQ(data->members.size(), 1U);
  EXPECT_THAT(data->left_out, ElementsAre("sub-AAAAAB: withdrew", "sub-AAAAAC: there is no task-*_events.tsv",
                                          "sub-STRAY: not in participants.tsv"));
  EXPECT_THAT(data->remarks, IsEmpty());
}

TEST_F(StudyFolder, NamesACutLineAndAMissingDescription) {
  writer_.add_person(0, identified("mica", "mica", "1") + "3\t1\tbl");
  std::filesystem::remove(folder_.file("sub-AAAAAA/task-three_events.json"));
  const auto data = read_study(folder_.path());
  ASSERT_TRUE(data.has_value()) << data.error().message;
  EXPECT_THAT(data->remarks, ElementsAre("sub-AAAAAA/task-three_events.tsv: line 3 was cut off and is left out",
                                         "sub-AAAAAA/task-three_events.json: there is no such file"));
}

TEST_F(StudyFolder, NamesFileAndLineOfAFault) {
  writer_.add_person(0, identified("mica", "gold", "1"));
  EXPECT_THAT(message(), HasSubstr("sub-AAAAAA/task-three_events.tsv:2: correct"));
}

TEST_F(StudyFolder, WaitsForNoPipeAndFollowsNoLoop) {
  writer_.add_person(0, identified("mica", "mica", "1"));
  const std::string events = folder_.file("sub-AAAAAA/task-three_events.tsv");
  std::filesystem::remove(events);
  ASSERT_EQ(::mkfifo(events.c_str(), 0600), 0);
  EXPECT_THAT(message(), HasSubstr("it is a pipe, not a file"));
  std::filesystem::remove(events);
  std::filesystem::create_symlink(events, events);
  EXPECT_THAT(message(), HasSubstr("task-three_events.tsv"));
  std::filesystem::remove(events);
  std::filesystem::create_symlink("/dev/zero", events);
  EXPECT_THAT(message(), HasSubstr("it is a device, not a file"));
}

}  // namespace study_data_test
}  // namespace afm::study
