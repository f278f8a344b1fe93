// SPDX-License-Identifier: Apache-2.0
// Invariant: a killed lesson loses at most the running trial
#include "exhibit/lesson/data_set.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "core/file_descriptor.h"
#include "core/version.h"
#include "core/whole_file.h"
#include "exhibit/lesson/lesson_samples.h"
#include "study/age_band.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::exhibit {
namespace data_set_test {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class DataSetTest : public ::testing::Test {
 protected:
  DataSetTest() {
    lesson_.id = "test";
    lesson_.title.texts = {"Test", "Prüfung"};
    lesson_.digest = "0123456789abcdef";
  }
  DataSetEntry entry(const std::string& code, std::optional<std::int64_t> day = std::nullopt) const {
    return {.folder = study(), .code = code, .device = "mouse", .wall = "own", .seed = 12, .day = day};
  }
  std::string study() const { return folder_.file("study"); }
  std::string text(const std::string& name) const { return core::read_file(study() + "/" + name).value(); }

  Lesson lesson_;
  const support::ScratchFolder folder_;
};

TEST_F(DataSetTest, HasItsTablesAndTheirDescriptions) {
  auto data = DataSet::create(lesson_, entry("ABCDEF"));
  ASSERT_TRUE(data) << data.error().message;
  ASSERT_TRUE(data->add({.onset_s = 1.5,
                         .duration_s = 2,
                         .step = "blind",
                         .kind = StepKind::Identify,
                         .condition = Condition::Both,
                         .practice = true,
                         .trial = 3,
                         .level = 0.25,
                         .stimulus = "mica",
                         .response = "gold",
                         .correct = false,
                         .rt_s = 0.5,
                         .force = true}));
  EXPECT_EQ(
      text("sub-ABCDEF/beh/sub-ABCDEF_task-test_events.tsv"),
      "onset\tduration\tstep\ttrial_type\tcondition\tpractice\ttrial\tlevel\tstimulus\tresponse\tcorrect\trt\tforce"
      "\tstrokes\tlosses\tundos\twork\tlargest_force\taids\n"
      "1.500\t2.000\tblind\tidentify\tboth\t1\t3\t0.25\tmica\tgold\t0\t0.500\t1\tn/a\tn/a\tn/a\tn/a\tn/a\tn/a\n")
      << "a line is there as soon as its trial is over";
  EXPECT_EQ(text("participants.tsv"), "participant_id\torder\tage_band\tcomfort\nsub-ABCDEF\t0\tn/a\tn/a\n");
  ASSERT_TRUE(data->finish(LessonEnd::Finished));
  EXPECT_EQ(text("participants.tsv"), "participant_id\torder\tage_band\tcomfort\nsub-ABCDEF\t0\tn/a\tfinished\n");
  const auto json = nlohmann::json::parse(text("sub-ABCDEF/beh/sub-ABCDEF_task-test_events.json"));
  EXPECT_EQ(json["onset"]["Units"], "s");
  EXPECT_EQ(json["trial_type"]["Levels"].size(), kStepKinds.size());
  for (const char* column : {"strokes", "losses", "undos", "work", "largest_force", "aids"}) {
    EXPECT_TRUE(json.contains(column) && json[column].contains("Description")) << column;
  }
  EXPECT_EQ(json["work"]["Units"], "aJ");
  EXPECT_EQ(json["largest_force"]["Units"], "nN");
  EXPECT_EQ(json["Lesson"]["title"]["de"], "Prüfung");
  EXPECT_EQ(json["Lesson"]["seed"], 12);
  EXPECT_EQ(json["Lesson"]["device"], "mouse");
  EXPECT_EQ(json["Lesson"]["scale"], "fit");
  for (const char* column : {"participant_id", "order", "age_band", "comfort"}) {
    EXPECT_TRUE(nlohmann::json::parse(text("participants.json")).contains(column)) << column;
  }
}

// Tables of BIDS have no header: the JSON beside each has what others have there.
TEST_F(DataSetTest, NamesTheProgramAndTheSamplesBesideItsTables) {
  const auto library = scene::load_materials(support::source("assets/materials.toml"));
  lesson_.materials = {"mica", "gold"};
  DataSetEntry described = entry("ABCDEF");
  described.samples = samples_json(lesson_, *library).value();
  ASSERT_TRUE(DataSet::create(lesson_, described));
  const auto events = nlohmann::json::parse(text("sub-ABCDEF/beh/sub-ABCDEF_task-test_events.json"));
  const auto people = nlohmann::json::parse(text("participants.json"));
  for (const auto& json : {events, people}) {
    EXPECT_EQ(json["StimulusPresentation"]["SoftwareName"], "TouchAFM");
    EXPECT_EQ(json["StimulusPresentation"]["SoftwareVersion"], core::kVersion);
  }
  ASSERT_EQ(events["Samples"].size(), 2U);
  EXPECT_EQ(events["Samples"]["gold"]["parameters"]["tip_radius_m"], 50e-9);
  for (const auto& [key, source] : events["Samples"]["mica"]["sources"].items()) {
    EXPECT_FALSE(source["source"].get<std::string>().empty()) << key;
  }
  EXPECT_TRUE(events["Samples"]["mica"]["sources"].contains("hamaker"));
  lesson_.materials = {"cheese"};
  EXPECT_FALSE(samples_json(lesson_, *library));
}

TEST_F(DataSetTest, RefusesALessonThatWasDoneAndKeepsItsTrials) {
  ASSERT_TRUE(DataSet::create(lesson_, entry("ABCDEF")));
  const std::string before = text("sub-ABCDEF/beh/sub-ABCDEF_task-test_events.tsv");
  const auto again = DataSet::create(lesson_, entry("ABCDEF"));
  ASSERT_FALSE(again.has_value());
  EXPECT_EQ(again.error().category, core::ErrorCategory::WrongUsage);
  EXPECT_THAT(again.error().message, HasSubstr("--withdraw ABCDEF"));
  EXPECT_EQ(text("sub-ABCDEF/beh/sub-ABCDEF_task-test_events.tsv"), before);
  lesson_.id = "other";
  EXPECT_TRUE(DataSet::create(lesson_, entry("ABCDEF"))) << "another lesson is another file";
  EXPECT_EQ(order_of(study(), "ABCDEF").value(), 0U);
}

TEST_F(DataSetTest, GivesEachParticipantThenextOrderAndAWithdrawnOneAgain) {
  for (const char* code : {"AAAAAA", "BBBBBB", "CCCCCC"}) ASSERT_TRUE(DataSet::create(lesson_, entry(code)));
  EXPECT_EQ(order_of(study(), "CCCCCC").value(), 2U);
  EXPECT_EQ(order_of(study(), "DDDDDD").value(), 3U);
  ASSERT_TRUE(withdraw(study(), "BBBBBB"));
  EXPECT_FALSE(fs::exists(study() + "/sub-BBBBBB"));
  EXPECT_THAT(text("participants.tsv"), ::testing::Not(HasSubstr("BBBBBB")));
  EXPECT_THAT(text("participants.tsv"), HasSubstr("CCCCCC"));
  EXPECT_TRUE(fs::exists(study() + "/sub-CCCCCC"));
  EXPECT_EQ(order_of(study(), "DDDDDD").value(), 1U) << "the design stays balanced";
  const auto again = withdraw(study(), "BBBBBB");
  ASSERT_FALSE(again.has_value());
  EXPECT_EQ(again.error().category, core::ErrorCategory::WrongUsage);
}

// Two lessons that begin at once on two machines: each keeps the order that it was planned with.
TEST_F(DataSetTest, KeepsTheOrderThatALessonWasPlannedBy) {
  DataSetEntry planned = entry("AAAAAA");
  planned.order = order_of(study(), "AAAAAA").value();
  DataSetEntry other = entry("BBBBBB");
  other.order = order_of(study(), "BBBBBB").value();
  EXPECT_EQ(DataSet::create(lesson_, planned)->order(), 0U);
  EXPECT_EQ(DataSet::create(lesson_, other)->order(), 0U);
  EXPECT_THAT(text("participants.tsv"), HasSubstr("sub-BBBBBB\t0\t"));
  EXPECT_EQ(DataSet::create(lesson_, entry("CCCCCC"))->order(), 1U) << "the next one that is free";
  Lesson another = lesson_;
  another.id = "another";
  EXPECT_EQ(DataSet::create(another, entry("CCCCCC"))->order(), 1U) << "a participant keeps theirs";
}

TEST_F(DataSetTest, CountsDaysFromTheFirstOneOfTheStudy) {
  const auto day_of = [&](const char* code) {
    return nlohmann::json::parse(
        text(std::string("sub-") + code + "/beh/sub-" + code + "_task-test_events.json"))["Lesson"]["started_day"];
  };
  ASSERT_TRUE(DataSet::create(lesson_, entry("SIMULA")));
  ASSERT_TRUE(DataSet::create(lesson_, entry("AAAAAA", 20'000)));
  ASSERT_TRUE(DataSet::create(lesson_, entry("BBBBBB", 20'003)));
  EXPECT_EQ(day_of("SIMULA"), 0);
  EXPECT_EQ(day_of("AAAAAA"), 0);
  EXPECT_EQ(day_of("BBBBBB"), 3);
}

TEST_F(DataSetTest, KeepsAnAgeBandThatWasGiven) {
  DataSetEntry young = entry("ABCDEF");
  young.age_band = "14-17";
  ASSERT_TRUE(DataSet::create(lesson_, young)->finish(LessonEnd::Finished));
  EXPECT_THAT(text("participants.tsv"), HasSubstr("sub-ABCDEF\t0\t14-17\tfinished\n"));
  lesson_.id = "other";
  ASSERT_TRUE(DataSet::create(lesson_, entry("ABCDEF")));
  EXPECT_THAT(text("participants.tsv"), HasSubstr("\t14-17\t")) << "a lesson without one forgets none";
  const auto levels = nlohmann::json::parse(text("participants.json"))["age_band"]["Levels"];
  ASSERT_EQ(levels.size(), study::kAgeBands.size());
  for (const study::AgeBandRow& band : study::kAgeBands) EXPECT_EQ(levels[std::string(band.word)], band.meaning);
}

TEST_F(DataSetTest, NotesThatTheSoundWasLostBesideWhatItSaidBefore) {
  auto data = DataSet::create(lesson_, entry("ABCDEF"));
  ASSERT_TRUE(data);
  const std::string name = "sub-ABCDEF/beh/sub-ABCDEF_task-test_events.json";
  auto before = nlohmann::json::parse(text(name));
  ASSERT_TRUE(data->note_sound_lost(12.5));
  before["Lesson"]["sound_lost_s"] = 12.5;
  EXPECT_EQ(nlohmann::json::parse(text(name)), before);
}

TEST_F(DataSetTest, RefusesATableOfParticipantsThatIsNone) {
  fs::create_directories(study());
  ASSERT_TRUE(core::write_file(study() + "/participants.tsv", "name\tage\nAnna\t12\n"));
  const auto data = DataSet::create(lesson_, entry("ABCDEF"));
  ASSERT_FALSE(data.has_value());
  EXPECT_EQ(data.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_EQ(text("participants.tsv"), "name\tage\nAnna\t12\n");
}

TEST_F(DataSetTest, WaitsForAnothersLockWithALimit) {
  fs::create_directories(study());
  core::FileDescriptor other(::open(study().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  ASSERT_EQ(::flock(other.get(), LOCK_SH), 0);
  const auto refused = DataSet::create(lesson_, entry("ABCDEF"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().category, core::ErrorCategory::Failed);
  EXPECT_THAT(refused.error().message, HasSubstr("within 5 s: another program holds its lock"));
  EXPECT_TRUE(fs::is_empty(study())) << "nothing half-made";
  std::jthread gives_way([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    other.close();
  });
  EXPECT_TRUE(DataSet::create(lesson_, entry("ABCDEF")));
}

TEST_F(DataSetTest, FollowsNoLinkThatHoldsTheNameOfItsFile) {
  fs::create_directories(study() + "/sub-ABCDEF/beh");
  fs::create_symlink(folder_.file("elsewhere"), study() + "/sub-ABCDEF/beh/sub-ABCDEF_task-test_events.tsv");
  EXPECT_FALSE(DataSet::create(lesson_, entry("ABCDEF")));
  EXPECT_FALSE(fs::exists(folder_.file("elsewhere")));
}

// The rules of BIDS 1.8.0 that a data set of events breaks easily; bids-validator 1.15 finds no error in it.
TEST_F(DataSetTest, KeepsTheRulesOfBids) {
  lesson_.id = "three-materials-2";
  ASSERT_TRUE(DataSet::create(lesson_, entry("ABCDEF")));
  const auto description = nlohmann::json::parse(text("dataset_description.json"));
  EXPECT_EQ(description["BIDSVersion"], "1.8.0");
  EXPECT_FALSE(description["Name"].get<std::string>().empty());
  EXPECT_GT(text("README").size(), 150U) << "shorter ones are warned of";
  EXPECT_EQ(text(".bidsignore"), "*_session/\n");
  const std::string stem = "sub-ABCDEF/beh/sub-ABCDEF_task-threematerials2_events";
  EXPECT_THAT(text(stem + ".tsv"), ::testing::StartsWith("onset\tduration\t"));
  for (const std::string& name : {stem + ".json", std::string("participants.json")}) {
    const auto json = nlohmann::json::parse(text(name));
    for (const auto& [column, described] : json.items()) {
      if (!described.contains("Levels")) continue;
      ASSERT_TRUE(described["Levels"].is_object()) << column;
      for (const auto& [level, meaning] : described["Levels"].items()) {
        EXPECT_FALSE(meaning.get<std::string>().empty()) << column << " " << level;
      }
    }
  }
}

TEST_F(DataSetTest, LeavesAReadmeOfTheirOwnAlone) {
  fs::create_directories(study());
  ASSERT_TRUE(core::write_file(study() + "/README.md", "ours\n"));
  ASSERT_TRUE(core::write_file(study() + "/dataset_description.json", "{}\n"));
  ASSERT_TRUE(DataSet::create(lesson_, entry("ABCDEF")));
  EXPECT_EQ(text("README.md"), "ours\n");
  EXPECT_EQ(text("dataset_description.json"), "{}\n");
  EXPECT_FALSE(fs::exists(study() + "/README"));
}

// A folder that version 0.2.0 has begun.
TEST_F(DataSetTest, GoesOnWithADataSetOfBefore) {
  fs::create_directories(study() + "/sub-ABCDEF");
  lesson_.id = "first-touch";
  ASSERT_TRUE(core::write_file(study() + "/sub-ABCDEF/task-first-touch_events.tsv", "onset\n"));
  ASSERT_TRUE(core::write_file(study() + "/participants.tsv",
                               "participant_id\torder\tage_band\tcomfort\nsub-ABCDEF\t0\tn/a\tfinished\n"));
  ASSERT_TRUE(core::write_file(study() + "/participants.json",
                               R"({"comfort": {"Levels": ["finished"]}, "Study": {"first_day": 20000},
                                   "StimulusPresentation": {"SoftwareName": "TouchAFM", "SoftwareVersion": "0.0.9"}})"));
  const auto again = DataSet::create(lesson_, entry("ABCDEF"));
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("sub-ABCDEF/task-first-touch_events.tsv exists"));
  ASSERT_TRUE(DataSet::create(lesson_, entry("BBBBBB", 20'002)));
  EXPECT_THAT(text("participants.tsv"), HasSubstr("sub-BBBBBB\t1\t"));
  const auto json = nlohmann::json::parse(text("participants.json"));
  EXPECT_TRUE(json["comfort"]["Levels"].is_object());
  EXPECT_EQ(json["Study"]["first_day"], 20'000);
  EXPECT_EQ(json["StimulusPresentation"]["SoftwareVersion"], core::kVersion) << "that of the newest lesson";
}

TEST_F(DataSetTest, ReadsAListThatASpreadsheetHasSaved) {
  fs::create_directories(study());
  ASSERT_TRUE(core::write_file(study() + "/participants.tsv",
                               "\xEF\xBB\xBFparticipant_id\torder\tage_band\tcomfort\r\n"
                               "sub-AAAAAA\t0\t18-24\tfinished\r\n"));
  const auto data = DataSet::create(lesson_, entry("ABCDEF"));
  ASSERT_TRUE(data) << data.error().message;
  EXPECT_EQ(data->order(), 1U);
  EXPECT_THAT(text("participants.tsv"), HasSubstr("\nsub-AAAAAA\t0\t18-24\tfinished\nsub-ABCDEF\t1\t"));
}

TEST(ParticipantCode, IsSixCapitalLetters) {
  EXPECT_TRUE(is_participant_code("ABCDEF"));
  for (const char* wrong : {"", "ABCDE", "ABCDEFG", "abcdef", "ABCDE1", "../../"}) {
    EXPECT_FALSE(is_participant_code(wrong)) << wrong;
  }
}

}  // namespace data_set_test
}  // namespace afm::exhibit
