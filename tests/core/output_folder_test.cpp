// SPDX-License-Identifier: Apache-2.0
// Invariant: results appear completely or not at all
#include "core/output_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "core/whole_file.h"
#include "support/scratch_folder.h"

namespace afm::core {
namespace output_folder_test {

namespace fs = std::filesystem;

std::size_t entries(const std::string& path) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
}

TEST(OutputFolder, ShowsNothingUntilItIsCommitted) {
  const support::ScratchFolder scratch;
  const std::string path = scratch.file("new/out");
  auto out = OutputFolder::open(path);
  ASSERT_TRUE(out.has_value());
  ASSERT_TRUE(out->write("a.txt", "a").has_value());
  EXPECT_FALSE(fs::exists(path + "/a.txt"));
  ASSERT_TRUE(out->commit().has_value());
  EXPECT_EQ(read_file(path + "/a.txt").value(), "a");
}

TEST(OutputFolder, LeavesNothingBehindWithoutACommit) {
  const support::ScratchFolder scratch;
  {
    auto out = OutputFolder::open(scratch.path());
    ASSERT_TRUE(out.has_value());
    ASSERT_TRUE(out->write("a.txt", "a").has_value());
  }
  EXPECT_EQ(entries(scratch.path()), 0U);
}

TEST(OutputFolder, NamesAFileThatCannotBeWrittenAsItWouldBeSeen) {
  const support::ScratchFolder scratch;
  auto out = OutputFolder::open(scratch.path());
  ASSERT_TRUE(out.has_value());
  const std::string name(300, 'n');
  const auto written = out->write(name, "a");
  ASSERT_FALSE(written.has_value());
  EXPECT_THAT(written.error().message, testing::HasSubstr("cannot write " + scratch.path() + "/" + name));
}

TEST(OutputFolder, ReplacesItsOwnFilesAndKeepsTheOthers) {
  const support::ScratchFolder scratch;
  scratch.write("a.txt", "old");
  scratch.write("mine.txt", "mine");
  {
    auto out = OutputFolder::open(scratch.path());
    ASSERT_TRUE(out.has_value());
    ASSERT_TRUE(out->write("a.txt", "new").has_value());
    ASSERT_TRUE(out->commit().has_value());
  }
  EXPECT_EQ(read_file(scratch.file("a.txt")).value(), "new");
  EXPECT_EQ(read_file(scratch.file("mine.txt")).value(), "mine");
  EXPECT_EQ(entries(scratch.path()), 2U);
}

TEST(OutputFolder, OfNewFilesReplacesNoneAndThenShowsNone) {
  const support::ScratchFolder scratch;
  scratch.write("b.txt", "old");
  {
    auto out = OutputFolder::open(scratch.path());
    ASSERT_TRUE(out.has_value());
    for (const char* name : {"a.txt", "b.txt", "c.txt"}) ASSERT_TRUE(out->write(name, "new").has_value());
    const auto committed = out->commit_new();
    ASSERT_FALSE(committed.has_value());
    EXPECT_EQ(committed.error().category, ErrorCategory::WrongUsage);
    EXPECT_THAT(committed.error().message, testing::HasSubstr("b.txt: it exists already"));
  }
  EXPECT_EQ(read_file(scratch.file("b.txt")).value(), "old");
  EXPECT_EQ(entries(scratch.path()), 1U) << "neither what came before it nor what comes after";
}

TEST(OutputFolder, OfNewFilesShowsAll) {
  const support::ScratchFolder scratch;
  {
    auto out = OutputFolder::open(scratch.path());
    ASSERT_TRUE(out.has_value());
    for (const char* name : {"a.txt", "b.txt"}) ASSERT_TRUE(out->write(name, name).has_value());
    ASSERT_TRUE(out->commit_new().has_value());
  }
  EXPECT_EQ(read_file(scratch.file("a.txt")).value(), "a.txt");
  EXPECT_EQ(read_file(scratch.file("b.txt")).value(), "b.txt");
  EXPECT_EQ(entries(scratch.path()), 2U);
}

// A run that is killed between two moves has shown the truth of a file, and not yet the file.
TEST(OutputFolder, OfNewFilesMovesTheLongestNameFirst) {
  const support::ScratchFolder scratch;
  for (const char* name : {"a.h5", "a.h5.truth.json", "a.h5.truth.gwy"}) scratch.write(name, "old");
  auto out = OutputFolder::open(scratch.path());
  ASSERT_TRUE(out.has_value());
  for (const char* name : {"a.h5", "a.h5.truth.gwy", "a.h5.truth.json"}) {
    ASSERT_TRUE(out->write(name, "new").has_value());
  }
  for (const char* first : {"a.h5.truth.json", "a.h5.truth.gwy", "a.h5"}) {
    const auto committed = out->commit_new();
    ASSERT_FALSE(committed.has_value()) << first;
    EXPECT_THAT(committed.error().message, testing::HasSubstr(std::string(first) + ": it exists already"));
    fs::remove(scratch.file(first));
  }
  EXPECT_TRUE(out->commit_new());
}

TEST(OutputFolder, ClearsWhatAKilledRunHasLeft) {
  const support::ScratchFolder scratch;
  fs::create_directory(scratch.file(".unfinished-a1b2c3"));
  scratch.write(".unfinished-a1b2c3/a.txt", "half");
  {
    auto out = OutputFolder::open(scratch.path());
    ASSERT_TRUE(out.has_value());
    ASSERT_TRUE(out->commit().has_value());
  }
  EXPECT_EQ(entries(scratch.path()), 0U);
}

TEST(OutputFolder, LeavesWhatAnotherRunIsWriting) {
  const support::ScratchFolder scratch;
  auto other = OutputFolder::open(scratch.path());
  ASSERT_TRUE(other && other->write("a.txt", "a"));
  auto out = OutputFolder::open(scratch.path());
  ASSERT_TRUE(out && out->commit() && other->commit());
  EXPECT_EQ(read_file(scratch.file("a.txt")).value(), "a");
}

TEST(OutputFolder, ThatIsAFileIsRefusedAtOnce) {
  const support::ScratchFolder scratch;
  const auto out = OutputFolder::open(scratch.write("file", "x"));
  ASSERT_FALSE(out.has_value());
  EXPECT_EQ(out.error().category, ErrorCategory::Failed);
  EXPECT_THAT(out.error().message, ::testing::HasSubstr("choose another with --out"));
}

}  // namespace output_folder_test
}  // namespace afm::core
