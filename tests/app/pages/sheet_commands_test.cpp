// SPDX-License-Identifier: Apache-2.0
// Every command in the sheet of features in docs/comparison.md does its work as printed, with the reader's files.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <regex>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/whole_file.h"
#include "support/places.h"
#include "support/programs/run_touchafm.h"
#include "support/scratch_folder.h"

namespace afm::app {
namespace sheet_commands_test {

// Words for which a reader puts something, longer ones first.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kReplaced{
    std::pair{"--thermal FILE", "--thermal volts.txt"},
    std::pair{"--out FILE.h5", "--out written.h5"},
    std::pair{"FILES", "gel.h5 sticky.h5"},
    std::pair{"FILE", "gel.h5"},
    std::pair{"MAP", "map.h5"},
    std::pair{"SHAPE", "paraboloid --radius 5um"},
    std::pair{"FOLDER", "$(mktemp -d -p .)"},
    std::pair{"METHOD", "fit-polynomial"},
    std::pair{"MODEL", "jkr"},
    std::pair{"NEW", "converted.tab"},
};

std::string typed(std::string command) {
  for (const auto& [word, text] : kReplaced) {
    for (std::size_t at = 0; (at = command.find(word, at)) != std::string::npos; at += text.size()) {
      command.replace(at, word.size(), text);
    }
  }
  return command;
}

// The commands of each row's cell, without "touchafm".
std::vector<std::string> commands_of_the_sheet() {
  std::istringstream lines(core::read_file(support::source("docs/comparison.md")).value());
  const std::regex row(R"(\| \d+ \| [^|]+ \| ([^|]*) ?\| [012] \|)"), quoted("`touchafm ([^`]+)`");
  std::vector<std::string> commands;
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (!std::regex_match(line, found, row)) continue;
    const std::string cell = found[1];
    for (std::sregex_iterator each(cell.begin(), cell.end(), quoted), end; each != end; ++each) {
      commands.push_back((*each)[1]);
    }
  }
  return commands;
}

TEST(SheetCommands, Run) {
  const support::ScratchFolder folder;
  folder.write("volts.txt", core::read_file(support::source("tests/fuzz/corpus/spectrum/volts.txt")).value());
  const std::string here = fmt::format("cd {} && {} ", folder.path(), support::touchafm());
  for (const char* made :
       {"curve --modulus 3kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN --noise 15pN --out gel.h5",
        "curve --law jkr --radius 1um --modulus 1MPa --work-of-adhesion 20mJ/m2 --spring-constant 1N/m --most-force "
        "200nN --noise 300pN --out sticky.h5",
        "map --pixels 2x2 --modulus 2kPa --radius 5um --spring-constant 0.05N/m --most-force 1nN --out map.h5"}) {
    ASSERT_EQ(support::run_program(here + "generate " + made).exit_code, 0) << made;
  }
  int run = 0, windows = 0;
  for (const std::string& command : commands_of_the_sheet()) {
    // tests of the live window open it
    if (command.starts_with("view")) {
      ++windows;
      continue;
    }
    ++run;
    const auto result = support::run_program(here + typed(command));
    EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.err;
  }
  EXPECT_GE(run, 22);
  EXPECT_EQ(windows, 2);
}

}  // namespace sheet_commands_test
}  // namespace afm::app
