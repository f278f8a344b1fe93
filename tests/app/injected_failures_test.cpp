// SPDX-License-Identifier: Apache-2.0
// Invariant: a failed allocation or system call leads to one line of output, never to a partial file
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <sstream>
#include <string>

#include "core/whole_file.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

// The program while one allocation or one system call fails: it does its work all the same, or says one line and ends
// with a code of the table, and leaves nothing partial.
namespace afm::app {
namespace injected_failures_test {

struct Command {
  const char* name;
  std::string line;
};
// Quick ones, which need neither a device nor a picture.
const Command kCommands[]{
    {"curve", "curve --material mica --step 1nm"},
    {"material", "material gold"},
    {"wall", "wall " + support::source("assets/walls/3d-tv.toml")},
    {"analyse", "analyse " + support::source("tests/formats/0.1.0/curve.csv")},
};

support::ProgramResult with_failure(const std::string& wish, const std::string& report, const std::string& line) {
  return support::run_program("env LD_PRELOAD=" + support::failing_calls() + " AFM_FAIL=" + wish +
                              " AFM_FAIL_REPORT=" + report + " " + support::touchafm() + " " + line);
}

class InjectedFailures : public ::testing::TestWithParam<Command> {
 protected:
  // Every failure of one kind, each in a separate process; returns how many there were.
  long expect_every_one_borne(const std::string& kind) const {
    const std::string report = folder_.file(kind);
    const auto whole = with_failure(kind + ":all", report, GetParam().line);
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    std::istringstream lines(core::read_file(report).value_or(""));
    std::map<std::string, std::string> results;  // first line of each
    long tried = 0;
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("count")) break;
      std::istringstream words(line);
      long number = 0;
      std::string call, hash;
      int status = 0, said = 0;
      words >> number >> call >> status >> said >> hash;
      EXPECT_FALSE(words.fail()) << line;
      EXPECT_EQ(number, ++tried);
      EXPECT_TRUE(WIFEXITED(status)) << line << " ended by signal " << WTERMSIG(status) << ": "
                                     << core::read_file(report + ".err").value_or("");
      const int code = WEXITSTATUS(status);
      EXPECT_TRUE(code == 0 || code == 1 || code == 3) << line;
      if (code == 0) results.emplace(hash, line);
      EXPECT_LE(said, 1) << line << ": " << core::read_file(report + ".err").value_or("");
      EXPECT_TRUE(code == 0 || said == 1) << line;
      if (HasFailure()) return tried;
    }
    EXPECT_LE(results.size(), 1U) << "a run that ended with 0 printed something else: "
                                  << testing::PrintToString(results);
    std::printf("%s: %ld failures of %s\n", GetParam().name, tried, kind.c_str());
    return tried;
  }

  support::ScratchFolder folder_;
};

TEST_P(InjectedFailures, OfEveryAllocationAreBorne) { EXPECT_GT(expect_every_one_borne("memory"), 1000); }

TEST_P(InjectedFailures, OfEverySystemCallAreBorne) { EXPECT_GE(expect_every_one_borne("calls"), 1); }

INSTANTIATE_TEST_SUITE_P(Of, InjectedFailures, testing::ValuesIn(kCommands),
                         [](const auto& test) { return std::string(test.param.name); });

// Number of calls in a run without failures.
long counted(const std::string& report) {
  long count = 0;
  std::string word;
  std::istringstream(core::read_file(report).value_or("")) >> word >> count;
  return count;
}

// The whole work, or a code of the table, one line, and no file in `out`. True: the whole work.
bool expect_whole_or_nothing(const support::ProgramResult& done, const support::ScratchFolder& out,
                             const std::string& what) {
  const bool whole = done.exit_code == 0;
  EXPECT_TRUE(whole || done.exit_code == 1 || done.exit_code == 3) << what << ": " << done.err;
  EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), whole ? 0 : 1) << what << ": " << done.err;
  EXPECT_EQ(std::filesystem::is_empty(out.path()), !whole) << what << ": " << done.err;
  return whole;
}

// Files are written whole or not at all, whichever call fails in between.
TEST(InjectedFailure, LeavesNoPartOfAFile) {
  const support::ScratchFolder reports;
  const std::string line = "curve --material mica --step 1nm --out ";
  for (const std::string kind : {"calls", "memory"}) {
    std::minstd_rand random(15);
    long count = -1, failed = 0;
    for (long run = 0; count < 0 || run < 60; ++run) {
      const support::ScratchFolder out;
      const std::string report = reports.file(kind + std::to_string(run));
      // the calls one after the other, and every allocation of the last fiftieth, in which the file is written, as
      // likely
      const long number = run == 0 ? 0 : kind == "calls" ? run : count - static_cast<long>(random()) % (count / 50);
      if (kind == "calls" && count >= 0 && number > count) break;
      const auto done = with_failure(kind + ":" + std::to_string(number), report, line + out.file("curve.csv"));
      if (run == 0) {
        ASSERT_EQ(done.exit_code, 0) << done.err;
        count = counted(report);
        ASSERT_GE(count, 5) << kind;
        continue;
      }
      failed += expect_whole_or_nothing(done, out, kind + std::to_string(number)) ? 0 : 1;
    }
    EXPECT_GT(failed, 0) << kind;
  }
}

// A picture, with failures only in the program's own calls, because its driver would end any program. Every call, and
// 100 of some 43 000 allocations: 50 of all, and 50 of the last fiftieth, in which the frame is drawn and written.
TEST(InjectedFailure, OfAPictureIsBorne) {
  const support::ScratchFolder reports;
  for (const std::string kind : {"calls", "memory"}) {
    std::minstd_rand random(15);
    long count = -1, failed = 0;
    for (long run = 0; run <= (kind == "calls" ? count : 100) || run == 0; ++run) {
      const support::ScratchFolder out;
      const std::string report = reports.file(kind + std::to_string(run));
      const long among = run > 50 ? count / 50 : count;
      const long number = kind == "calls" || run == 0 ? run : count - static_cast<long>(random()) % among;
      const auto done = with_failure(kind + ":" + std::to_string(number) + " AFM_FAIL_PROGRAM=1", report,
                                     "render --journey 4 --size 64x48 --out " + out.file("picture.png"));
      if (run == 0) {
        ASSERT_EQ(done.exit_code, 0) << done.err;
        count = counted(report);
        ASSERT_GE(count, 10) << kind;
        continue;
      }
      failed += expect_whole_or_nothing(done, out, kind + std::to_string(number)) ? 0 : 1;
    }
    EXPECT_GT(failed, 0) << kind;
  }
}

}  // namespace injected_failures_test
}  // namespace afm::app
