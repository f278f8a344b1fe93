// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"

// The program under limits of memory, threads and the size of files: one line, exit code 1, nothing partial.
namespace afm::app {
namespace {

using ::testing::HasSubstr;

// The limit of threads counts those of one user, and does not count for root.
support::ProgramResult under(const std::string& limit, const std::string& arguments) {
  const std::string as_somebody = ::geteuid() == 0 ? "setpriv --reuid 65533 --regid 65533 --clear-groups " : "";
  return support::run_program("timeout 60 " + as_somebody + "bash -c 'ulimit " + limit + "; exec " AFM_PROGRAM " " +
                              arguments + "'");
}

void expect_one_line(const support::ProgramResult& done, const std::string& what) {
  EXPECT_EQ(done.exit_code, 1) << done.err;
  EXPECT_THAT(done.err, HasSubstr("touchafm: error: " + what));
  EXPECT_EQ(std::count(done.err.begin(), done.err.end(), '\n'), 1) << done.err;
}

class Limits : public ::testing::Test {
 protected:
  Limits() { std::filesystem::permissions(folder_.path(), std::filesystem::perms::all); }
  support::ScratchFolder folder_;
};

TEST_F(Limits, OfTheSizeOfFilesLeaveNothingPartial) {
  for (const std::string& command : {"curve --material mica --step 0.01nm --out " + folder_.file("curve.csv"),
                                     "render --journey 4 --size 320x240 --out " + folder_.file("lever.png")}) {
    expect_one_line(under("-f 4", command), "cannot write " + folder_.path());
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  }
}

// lavapipe draws with a thread a processor and one more; without them it would never finish.
TEST_F(Limits, OfThreadsAreSaidBeforeAnythingIsDrawn) {
  expect_one_line(under("-u 3", "render --journey 4 --size 64x48 --out " + folder_.file("lever.png")),
                  "cannot start another thread");
  expect_one_line(under("-u 1", "wall " AFM_SOURCE_DIR "/assets/walls/3d-tv.toml"), "cannot start another thread");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(Limits, OfMemoryAreSaidInOneLine) {
  const auto done = under("-v 100000", "curve --material mica --step 0.0001nm --out " + folder_.file("curve.csv"));
  expect_one_line(done, "no memory is left");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace afm::app
