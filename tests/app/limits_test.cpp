// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "core/whole_file.h"
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

// Without pictures: lavapipe 25 keeps its memory in a file, and dies by SIGBUS if that is limited.
TEST_F(Limits, OfTheSizeOfFilesLeaveNothingPartial) {
  for (const std::string format : {"csv", "tab"}) {
    const std::string command = "curve --material mica --step 0.01nm --format " + format + " --out ";
    expect_one_line(under("-f 4", command + folder_.file("curve." + format)), "cannot write " + folder_.path());
    EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  }
}

// A disk without room keeps no empty table of fits, which would refuse the next try.
TEST_F(Limits, OfTheSizeOfFilesLeaveNoEmptyTable) {
  const std::string curve = folder_.file("gel.csv"), fits = folder_.file("fits");
  const std::string generate =
      "generate curve --radius 5um --modulus 3kPa --spring-constant 0.05N/m --most-force 1nN --out " + curve;
  ASSERT_EQ(support::run_program(support::touchafm() + " " + generate).exit_code, 0);
  const std::string fit = "analyse " + curve + " --fit sphere --radius 5um --out " + fits;
  EXPECT_EQ(under("-f 0", fit).exit_code, 1);
  EXPECT_FALSE(std::filesystem::exists(fits + "/fits.tsv"));
  const auto next = under("-t 60", fit);
  EXPECT_EQ(next.exit_code, 0) << next.err;
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

// Drawing needs more than 1 MiB, and a program without stack ends by SIGSEGV. A soft limit is raised.
TEST_F(Limits, OfTheStackAreSaidOrRaised) {
  const std::string draw = "render --journey 4 --size 64x48 --out " + folder_.file("lever.png");
  expect_one_line(under("-s 512", draw), "the stack is limited to less than 2 MiB");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
  const auto raised = under("-S -s 300", draw);
  EXPECT_EQ(raised.exit_code, 0) << raised.err;
  EXPECT_TRUE(std::filesystem::exists(folder_.file("lever.png")));
}

// Closed descriptors would be those of the next files, which the report and the log would then go into.
TEST_F(Limits, OfDescriptorsLetNoReportIntoAFile) {
  const std::string curve = folder_.file("gel.tab"), fits = folder_.file("fits");
  const std::string generate =
      "generate curve --radius 5um --modulus 3kPa --spring-constant 0.05N/m --most-force 1nN --out ";
  ASSERT_EQ(support::run_program(support::touchafm() + " " + generate + curve).exit_code, 0);
  const auto done = support::run_program("bash -c 'exec " + support::touchafm() + " analyse " + curve + " " + curve +
                                         " --fit sphere --radius 5um --out " + fits + " <&- >&- 2>&-'");
  EXPECT_EQ(done.exit_code, 1) << "the report cannot be printed";
  const std::string table = core::read_file(fits + "/fits.tsv").value();
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3) << table;
  const auto read = support::run_program("bash -c 'ulimit -t 2; ulimit -v 600000; exec " + support::touchafm() +
                                         " convert " + curve + " " + folder_.file("gel.h5") + "'");
  EXPECT_EQ(read.exit_code, 0) << "limits below those of the confined reader: " << read.err;
}

// A file name is any bytes; JSON is UTF-8.
TEST_F(Limits, OfUtf8AreNoneOfTheNamesOfFiles) {
  const std::string curve = folder_.file("gel\xFF.tab"), image = folder_.file("mica\xFF.gwy");
  for (const std::string& arguments :
       {"generate curve --radius 5um --modulus 3kPa --spring-constant 0.05N/m --most-force 1nN --out " + curve,
        "analyse --json " + curve, "analyse --json --fit sphere --radius 5um " + curve,
        "generate image --material mica --size 40nm --pixels 8 --out " + image, "analyse --json " + image,
        "scan --json --pixels 8 --sample " + image}) {
    const auto done = support::run_program(support::touchafm() + " " + arguments);
    EXPECT_EQ(done.exit_code, 0) << arguments << done.err;
  }
}

TEST_F(Limits, OfMemoryAreSaidInOneLine) {
  const auto done = under("-v 100000", "curve --material mica --step 0.0001nm --out " + folder_.file("curve.csv"));
  expect_one_line(done, "out of memory");
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace limits_test
}  // namespace afm::app
