// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

// The program under limits of memory, threads and the size of files: one line, exit code 1, nothing partial.
namespace afm::app {
namespace limits_test {

using ::testing::HasSubstr;

support::ProgramResult under(const std::string& limits, const std::string& arguments) {
  return support::run_program("timeout 60 bash -c 'ulimit " + limits + "; exec " + support::touchafm() + " " +
                              arguments + "'");
}

void expect_one_line(const support::ProgramResult& done, const std::string& what) {
  EXPECT_EQ(done.exit_code, 1) << done.err;
  EXPECT_THAT(done.err, HasSubstr("touchafm: error: " + what));
  EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
}

class Limits : public ::testing::Test {
 protected:
  support::ScratchFolder folder_;
};

// Without pictures: lavapipe 25 has its memory in a file, and dies by SIGBUS when that is limited.
TEST_F(Limits, OfTheSizeOfFilesLeaveNothingPartial) {
  for (const std::string format : {"csv", "tab"}) {
    const std::string command = "curve --material mica --step 0.01nm --format " + format + " --out ";
    expect_one_line(under("-f 4", command + folder_.file("curve." + format)), "cannot write " + folder_.path());
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  }
}

// As ulimit -u does, but for root too: stacks of 4 GB in an address space that has room for two or three, or for none.
// lavapipe draws with a thread a processor and one more; without them it would never finish.
TEST_F(Limits, OfThreadsAreSaidBeforeAnythingIsDrawn) {
  expect_one_line(under("-s 4000000 -v 12000000", "render --journey 4 --size 64x48 --out " + folder_.file("lever.png")),
                  "cannot start another thread");
  expect_one_line(under("-s 4000000 -v 3000000", "wall " + support::source("assets/walls/3d-tv.toml")),
                  "cannot start another thread");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(Limits, OfMemoryAreSaidInOneLine) {
  const auto done = under("-v 100000", "curve --material mica --step 0.0001nm --out " + folder_.file("curve.csv"));
  expect_one_line(done, "out of memory");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace limits_test
}  // namespace afm::app
