// SPDX-License-Identifier: Apache-2.0
#include "core/whole_file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include "core/exit_code.h"
#include "core/file_names.h"
#include "core/new_file.h"
#include "support/scratch_folder.h"

namespace afm::core {
namespace whole_file_test {

using ::testing::AnyOf;
using ::testing::EndsWith;
namespace fs = std::filesystem;

class WholeFile : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_.file(name); }
  std::string content(const std::string& name) const { return read_file(path(name)).value_or("nothing"); }
  std::ptrdiff_t files() const {
    return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
  }

  support::ScratchFolder folder_;
};

TEST_F(WholeFile, IsReplacedAndKeepsItsPermissions) {
  ASSERT_TRUE(write_file(path("a"), "one"));
  ASSERT_EQ(::chmod(path("a").c_str(), 0640), 0);
  ASSERT_TRUE(write_file(path("a"), std::string("t\0wo", 4)));
  EXPECT_EQ(content("a"), std::string("t\0wo", 4));
  EXPECT_EQ(fs::status(path("a")).permissions(), fs::perms(0640));
  EXPECT_EQ(files(), 1);
}

TEST_F(WholeFile, ThatIsNewReplacesNoFile) {
  ASSERT_TRUE(write_new_file(path("a"), "one"));
  const auto second = write_new_file(path("a"), "two");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().category, ErrorCategory::WrongUsage);
  EXPECT_THAT(second.error().message, EndsWith("no file is replaced; choose another name"));
  EXPECT_EQ(content("a"), "one");
  EXPECT_EQ(files(), 1);
}

// If two programs write a file at the same time, one is refused.
TEST_F(WholeFile, ThatIsNewIsWrittenByOneOfMany) {
  constexpr int kWriters = 8;
  std::atomic<int> written{0};
  std::vector<std::jthread> writers;
  for (int i = 0; i < kWriters; ++i) {
    writers.emplace_back([&] { written += write_new_file(path("a"), "mine") ? 1 : 0; });
  }
  writers.clear();
  EXPECT_EQ(written, 1);
  EXPECT_EQ(files(), 1);
}

// Links under former names of temporary files: their targets must not be touched.
TEST_F(WholeFile, FollowsNoLinkThatWasLaidForIt) {
  folder_.write("victim", "precious");
  for (const char* suffix : {".part", ".partial", ".tmp"}) fs::create_symlink(path("victim"), path("a") + suffix);
  ASSERT_TRUE(write_file(path("a"), "mine"));
  EXPECT_EQ(content("victim"), "precious");
  EXPECT_EQ(content("a"), "mine");
}

TEST_F(WholeFile, IsWrittenThroughLinks) {
  fs::create_directory(path("far"));
  folder_.write("far/real", "old");
  fs::create_symlink("real", path("far/link"));
  fs::create_symlink("far/link", path("link"));
  fs::create_symlink("far/later", path("dangling"));
  ASSERT_TRUE(write_file(path("link"), "new"));
  ASSERT_TRUE(write_file(path("dangling"), "first"));
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_TRUE(fs::is_symlink(path("far/link")));
  EXPECT_EQ(content("far/real"), "new");
  EXPECT_EQ(content("far/later"), "first");
}

TEST_F(WholeFile, IsNotWhatALinkInACircleNames) {
  fs::create_symlink("b", path("a"));
  fs::create_symlink("a", path("b"));
  EXPECT_FALSE(write_file(path("a"), "x"));
  EXPECT_EQ(files(), 2);
}

TEST_F(WholeFile, DevicesAndPipesStayWhatTheyAre) {
  ASSERT_TRUE(write_file("/dev/null", "gone"));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));

  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::string got;
  std::thread reader([&] {
    const int end = ::open(path("pipe").c_str(), O_RDONLY | O_CLOEXEC);
    char byte = 0;
    while (::read(end, &byte, 1) == 1) got += byte;
    ::close(end);
  });
  EXPECT_TRUE(write_file(path("pipe"), std::string(200'000, 'x')));
  reader.join();
  EXPECT_EQ(got, std::string(200'000, 'x'));
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(WholeFile, APipeWithoutAReaderIsNotWaitedForIndefinitely) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  const auto begin = std::chrono::steady_clock::now();
  testing::internal::CaptureStderr();
  const auto written = write_file(path("pipe"), "x");
  EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("pipe is a pipe: waiting up to 5 s"));
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, EndsWith("pipe: no program reads from it"));
  const auto read = read_file(path("pipe"));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().category, ErrorCategory::BadInputFile);
  EXPECT_THAT(read.error().message, EndsWith("it is a pipe, not a file"));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST_F(WholeFile, LeavesNothingPartialWhereItCannotBeWritten) {
  EXPECT_FALSE(write_file(path("missing/a"), "x"));
  fs::create_directory(path("folder"));
  EXPECT_FALSE(write_file(path("folder"), "x"));
  EXPECT_EQ(files(), 1);
}

// Refused before the work whose result would be lost, without leaving a file.
TEST_F(WholeFile, IsRefusedInAdvanceWhereItCannotBeWritten) {
  fs::create_directory(path("folder"));
  EXPECT_TRUE(check_writable(path("new")));
  EXPECT_TRUE(check_writable("/dev/null"));
  EXPECT_TRUE(check_writable("name-in-the-working-folder"));
  EXPECT_THAT(check_writable(path("missing/a")).error().message,
              EndsWith("missing/a: there is no folder " + path("missing") + "; make it, or choose another"));
  fs::create_symlink(path("missing/far"), path("link"));
  EXPECT_THAT(check_writable(path("link")).error().message, EndsWith(path("missing") + "; make it, or choose another"));
  EXPECT_FALSE(check_writable(path("folder")));
  EXPECT_FALSE(check_writable("/proc/version/a"));
  EXPECT_EQ(files(), 2);
}

TEST_F(WholeFile, NamesAFolderThatTakesNoFileAndACurrentOneThatIsGone) {
  // for root; others have no right to write there
  EXPECT_THAT(write_file("/proc/a", "x").error().message,
              AnyOf(EndsWith("cannot write /proc/a: the folder /proc takes no new files; choose another"),
                    EndsWith("Permission denied")));
  const fs::path before = fs::current_path();
  fs::create_directory(path("gone"));
  fs::current_path(path("gone"));
  fs::remove(path("gone"));
  const auto written = write_file("a", "x");
  fs::current_path(before);
  EXPECT_EQ(written.error().message, "cannot write a: the current folder has been deleted; go to another");
}

TEST(FileNames, HaveNoSlash) {
  EXPECT_EQ(in_file_name("SiO2/Si"), "SiO2%2FSi");
  EXPECT_EQ(in_file_name("../x"), "..%2Fx");
  EXPECT_EQ(in_file_name("Gold, (111)"), "Gold, (111)");
}

TEST(FileNames, HaveAnEndingInSmallOrCapitalLetters) {
  EXPECT_TRUE(has_ending("a.svg", ".svg"));
  EXPECT_TRUE(has_ending("dir.png/A.SVG", ".svg"));
  EXPECT_FALSE(has_ending("a.svg.png", ".svg"));
  EXPECT_FALSE(has_ending("svg", ".svg"));
  EXPECT_TRUE(is_named_as_another("a.PNG", ".svg"));
  EXPECT_TRUE(is_named_as_another("a.svg", ".png"));
  EXPECT_FALSE(is_named_as_another("a.PNG", ".png"));
  EXPECT_FALSE(is_named_as_another("day 2.1", ".svg"));
  EXPECT_FALSE(is_named_as_another("a.png/picture", ".svg"));
}

TEST_F(WholeFile, NamesWhatIsNone) {
  std::ofstream(path("file")) << "x";
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(kind_of_no_file(path("file")), "");
  EXPECT_EQ(kind_of_no_file(path("nothing")), "");
  EXPECT_EQ(kind_of_no_file(path("pipe")), "a pipe");
  EXPECT_EQ(kind_of_no_file("/dev/null"), "a device");
  EXPECT_EQ(kind_of_no_file("/"), "a folder");
}

TEST_F(WholeFile, AFullDiskIsSaid) {
  const auto written = write_file("/dev/full", std::string(100'000, 'x'));
  ASSERT_FALSE(written);
  EXPECT_THAT(written.error().message, EndsWith("/dev/full: No space left on device"));
}

}  // namespace whole_file_test
}  // namespace afm::core
