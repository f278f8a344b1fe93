// SPDX-License-Identifier: Apache-2.0
// Ten thousand files in one command, some of them broken, huge or unreadable.
// Invariant: in a table of fits each file has its rows, whatever the others are; a killed program leaves whole rows
#include <gtest/gtest.h>

#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "curves/curve_file.h"
#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/samples/hertz_curve.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace many_files_test {

constexpr std::size_t kFiles = 10'000, kBroken = 100, kHuge = 10, kUnreadable = 10;
constexpr std::size_t kFaulty = kBroken + kHuge + kUnreadable;

class ManyFiles : public ::testing::Test {
 protected:
  ManyFiles() {
    const auto written = curves::write_curve(folder_.file("whole"), curves::CurveFormat::Tab, test::hertz_curve(100));
    EXPECT_TRUE(written) << written.error().message;
    const std::string whole = core::read_file(folder_.file("whole")).value();
    for (std::size_t i = 0; i < kFiles; ++i) {
      files_.push_back(folder_.file(std::to_string(i) + ".tab"));
      const std::size_t fault = fault_of(i);
      if (fault == kFaulty) {
        std::filesystem::create_hard_link(folder_.file("whole"), files_.back());
      } else if (fault < kBroken) {
        // cut, without a heading, or damaged in the middle
        const std::size_t cut = whole.size() * (fault + 1) / (kBroken + 1);
        folder_.write(std::to_string(i) + ".tab", fault % 3 == 0   ? whole.substr(0, cut)
                                                  : fault % 3 == 1 ? whole.substr(cut)
                                                                   : whole.substr(0, cut) + "\nx" + whole.substr(cut));
      } else if (fault < kBroken + kHuge) {
        folder_.write(std::to_string(i) + ".tab", whole);
        std::filesystem::resize_file(files_.back(), std::uintmax_t{3} << 30U);  // sparse file
      } else {
        make_unreadable(files_.back(), fault % 4);
      }
    }
  }

  // Fault of a file; kFaulty: none. The faults are spread over all files.
  static std::size_t fault_of(std::size_t file) {
    constexpr std::size_t kEvery = kFiles / kFaulty;
    return file % kEvery == 0 && file / kEvery < kFaulty ? file / kEvery * 7 % kFaulty : kFaulty;
  }

  static void make_unreadable(const std::string& file, std::size_t how) {
    if (how == 0) std::filesystem::create_directory(file);
    if (how == 1) std::filesystem::create_symlink("nowhere", file);
    if (how == 2) {
      ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
    }
    if (how == 3) std::filesystem::create_symlink(file, file);
  }

  std::vector<std::string> command(const std::string& out) const {
    std::vector<std::string> words{support::touchafm(), "analyse"};
    words.insert(words.end(), files_.begin(), files_.end());
    words.insert(words.end(), {"--fit", "paraboloid", "--radius", "5um", "--out", folder_.file(out)});
    return words;
  }
  std::string table(const std::string& out) const {
    return core::read_file(folder_.file(out + "/fits.tsv")).value_or("");
  }

  support::ScratchFolder folder_;
  std::vector<std::string> files_;
};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream rest(line);
  for (std::string cell; std::getline(rest, cell, '\t');) cells.push_back(cell);
  if (line.ends_with('\t')) cells.emplace_back();
  return cells;
}

TEST_F(ManyFiles, HaveARowEachAndAKillLeavesWholeRows) {
  support::LiveProgram whole(command("whole-run"), "");
  ASSERT_TRUE(whole.within(std::chrono::minutes(20), [&] { return whole.has_ended(); })) << whole.said();
  ASSERT_EQ(whole.ends(), 0) << whole.said();
  const std::string all = table("whole-run");
  std::istringstream lines(all);
  std::string line;
  std::getline(lines, line);
  const auto columns = cells_of(line).size();
  std::size_t faulty = 0;
  for (std::size_t i = 0; i < kFiles; ++i) {
    ASSERT_TRUE(std::getline(lines, line)) << i;
    const auto cells = cells_of(line);
    ASSERT_EQ(cells.size(), columns) << line;
    EXPECT_EQ(cells[0], files_[i]);
    if (fault_of(i) == kFaulty) {
      EXPECT_NEAR(std::stod(cells[3]), test::kHertzModulusPa, 0.01 * test::kHertzModulusPa) << line;
      continue;
    }
    ++faulty;
    EXPECT_EQ(cells[1], "none") << line;
    EXPECT_GT(cells[2].size(), 10U) << line;
  }
  EXPECT_FALSE(std::getline(lines, line)) << line;
  EXPECT_EQ(faulty, kFaulty);

  support::LiveProgram killed(command("killed"), "");
  ASSERT_TRUE(killed.within(std::chrono::minutes(5), [&] {
    const std::string now = table("killed");
    return std::count(now.begin(), now.end(), '\n') > 1000;
  })) << killed.said();
  killed.signal(SIGKILL);
  EXPECT_EQ(killed.ends(), 128 + SIGKILL);
  const std::string left = table("killed");
  EXPECT_LT(left.size(), all.size());
  EXPECT_TRUE(left.ends_with('\n'));
  EXPECT_TRUE(all.starts_with(left)) << "the rows of the whole run";
}

}  // namespace many_files_test
}  // namespace afm::app
