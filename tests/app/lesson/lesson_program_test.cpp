// SPDX-License-Identifier: Apache-2.0
// Lessons by the real program: the same bytes for a seed, and what is left when it is killed.
// Invariant: a simulated student's lesson has the same bytes for a seed; no lesson overwrites another
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <thread>

#include "core/whole_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

namespace afm {
namespace lesson_program_test {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kLessons = support::source("assets/lessons/");

support::ProgramResult lesson(const std::string& arguments) {
  return support::run_program(support::touchafm() + " lesson " + arguments);
}

// Every file of a folder.
std::map<std::string, std::string> contents(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), folder).string()] = core::read_file(entry.path().string()).value();
  }
  return files;
}

TEST(LessonProgram, WritesAStudyOfTwentySimulatedStudentsWithTheSameBytesForTheirSeeds) {
  const support::ScratchFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  for (const char* study : {"one", "two"}) {
    for (int seed = 1; seed <= 20; ++seed) {
      const auto done = lesson(kLessons + "three-materials.toml --participant sim:" + std::to_string(seed) + " --out " +
                               folder.file(study));
      ASSERT_EQ(done.exit_code, 0) << done.err;
    }
  }
  std::printf("two studies of twenty students: %.1f s\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  const auto one = contents(folder.file("one"));
  EXPECT_EQ(one.size(), 5U + 2U * 20U);
  EXPECT_EQ(one, contents(folder.file("two")));
}

TEST(LessonProgram, RefusesALessonThatAStudentHasDoneAndWithdrawsAStudent) {
  const support::ScratchFolder folder;
  const std::string out = " --out " + folder.file("study");
  const std::string run = kLessons + "first-touch.toml --participant sim:1" + out;
  ASSERT_EQ(lesson(run).exit_code, 0);
  const auto before = contents(folder.file("study"));
  const auto again = lesson(run);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("has done this lesson"));
  EXPECT_EQ(contents(folder.file("study")), before);
  std::string code;
  for (const auto& entry : fs::directory_iterator(folder.file("study"))) {
    if (entry.is_directory()) code = entry.path().filename().string().substr(4);
  }
  const auto withdrawn = lesson("--withdraw " + code + out);
  EXPECT_EQ(withdrawn.exit_code, 0) << withdrawn.err;
  EXPECT_FALSE(fs::exists(folder.file("study") + "/sub-" + code));
  EXPECT_EQ(lesson("--withdraw " + code + out).exit_code, 2);
  EXPECT_EQ(lesson("--withdraw ../../x" + out).exit_code, 2);
}

// Blind, by feeling and hearing alone: a sharp student names the state in most trials.
TEST(LessonProgram, AsksSimulatedStudentsForBothStatesOfALeverThatTaps) {
  const support::ScratchFolder folder;
  std::size_t attractive = 0, repulsive = 0, right = 0, trials = 0;
  for (int seed = 1; seed <= 4; ++seed) {
    const auto done = lesson(kLessons + "two-states.toml --participant sim:" + std::to_string(seed) +
                             ",d-prime=3 --out " + folder.file("study"));
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  for (const auto& [name, text] : contents(folder.file("study"))) {
    if (name.find("_events.tsv") == std::string::npos) continue;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      if (line.find("\tidentify\t") == std::string::npos) continue;
      ++trials;
      const bool felt_attractive = line.find("\tattractive\tattractive\t1\t") != std::string::npos;
      const bool felt_repulsive = line.find("\trepulsive\trepulsive\t1\t") != std::string::npos;
      right += felt_attractive || felt_repulsive ? 1U : 0U;
      attractive += line.find("\tattractive\t") != std::string::npos ? 1U : 0U;
      repulsive += line.find("\trepulsive\t") != std::string::npos ? 1U : 0U;
    }
  }
  EXPECT_EQ(trials, 4U * 10U) << "four before, two to practise and four after";
  EXPECT_GE(attractive, trials / 3);
  EXPECT_GE(repulsive, trials / 3);
  EXPECT_GE(right, trials * 3 / 4);
}

// A drive above the resonance, with which the stiff sample of this lesson enlarges the swing; in a window too.
TEST(LessonProgram, RefusesADriveUnderWhichASampleCannotBeFelt) {
  const support::ScratchFolder folder;
  const std::string out = " --participant sim:1 --out " + folder.file("study");
  std::string text = core::read_file(kLessons + "two-states.toml").value();
  const std::string before = "resonance = \"300 kHz\"";
  ASSERT_NE(text.find(before), std::string::npos);
  text.replace(text.find(before), before.size(), before + "\ndrive = \"318 kHz\"");
  const std::string driven = folder.write("driven.toml", text);
  const std::string why =
      "mica cannot be felt: with the drive 6 % above the resonance this sample enlarges the swing from 20 nm to at "
      "least";
  const auto alone = lesson(driven + out);
  EXPECT_EQ(alone.exit_code, 3);
  EXPECT_THAT(alone.err, HasSubstr("lesson file " + driven + ": " + why));
  const auto in_a_window = lesson(driven);
  EXPECT_EQ(in_a_window.exit_code, 3);
  EXPECT_THAT(in_a_window.err, HasSubstr("lesson file " + driven + ": " + why));
  EXPECT_FALSE(fs::exists(folder.file("study"))) << "nothing of a study that cannot begin";
}

TEST(LessonProgram, SaysWhatIsWrongInOneLine) {
  const support::ScratchFolder folder;
  const std::string out = " --out " + folder.file("study");
  const std::string bad = folder.write("bad.toml", "id = \"a\"\nspeed = 3\n");
  const auto unknown = lesson(bad + " --participant sim:1" + out);
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("line 2: speed: unknown key"));
  std::string of_copper = core::read_file(kLessons + "first-touch.toml").value();
  for (std::size_t at = of_copper.find("\"mica\""); at != std::string::npos; at = of_copper.find("\"mica\"")) {
    of_copper.replace(at, 6, "\"copper\"");
  }
  const std::string strange = folder.write("copper.toml", of_copper);
  for (const char* participant : {" --participant sim:1", ""}) {
    const auto refused = lesson(strange + participant + (*participant == '\0' ? "" : out));
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_THAT(refused.err, HasSubstr("lesson file " + strange + ": unknown material \"copper\"; choose "));
  }
  EXPECT_EQ(lesson(kLessons + "first-touch.toml --participant Anna" + out).exit_code, 2);
  EXPECT_EQ(lesson(kLessons + "first-touch.toml --participant sim:x" + out).exit_code, 2);
  EXPECT_EQ(lesson(kLessons + "first-touch.toml --participant sim:1").exit_code, 2);
  EXPECT_EQ(lesson("").exit_code, 2);
  const std::string heard = folder.write(
      "heard.toml",
      "id = \"a\"\ntitle = { en = \"A\", de = \"A\" }\nminutes = 1\nmaterials = [\"mica\"]\nscale = \"fit\"\n"
      "conditions = [\"both\", \"sound\"]\n[[step]]\nid = \"b\"\ntype = \"cycle\"\nmaterial = \"mica\"\n"
      "each_condition = true\nwords = { en = \"C\", de = \"C\" }\n");
  const auto silent = lesson(heard);
  EXPECT_EQ(silent.exit_code, 2) << "without sound its data would be those of another condition";
  EXPECT_THAT(silent.err, HasSubstr("add --sound"));
  EXPECT_FALSE(fs::exists(folder.file("study"))) << "what is refused leaves nothing";
}

// Whatever the moment, every line that is there is whole but the last, and whole trials are those of the run that was
// not killed.
TEST(LessonProgram, LosesAtMostTheRunningTrialWhenItIsKilled) {
  const support::ScratchFolder folder;
  const std::string file = kLessons + "measuring-adhesion.toml";
  ASSERT_EQ(lesson(file + " --participant sim:5 --out " + folder.file("whole")).exit_code, 0);
  const auto whole_files = contents(folder.file("whole"));
  std::string name, whole;
  for (const auto& [path, text] : whole_files) {
    if (path.ends_with("_events.tsv")) std::tie(name, whole) = std::pair(path, text);
  }
  ASSERT_FALSE(whole.empty());
  std::size_t cut = 0;
  for (int delay_ms = 2; delay_ms < 60 && cut < 3; delay_ms += 2) {
    const std::string study = folder.file("killed-" + std::to_string(delay_ms));
    support::LiveProgram program({support::touchafm(), "lesson", file, "--participant", "sim:5", "--out", study}, "");
    // until it has begun its file
    for (int i = 0; i < 2000 && !fs::exists(study + "/" + name); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms % 20));
    program.signal(SIGKILL);
    program.ends();
    const std::string left = core::read_file(study + "/" + name).value();
    EXPECT_EQ(whole.substr(0, left.size()), left) << "a killed run's trials are those of the whole run";
    EXPECT_TRUE(left.empty() || left.back() == '\n') << "each line is written at once";
    if (left.size() < whole.size()) ++cut;
  }
  EXPECT_GT(cut, 0U) << "no run was killed before its end";
}

}  // namespace lesson_program_test
}  // namespace afm
