// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "support/fenced_blocks.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

// Every command of docs/tutorial.md, typed in the page's order in an empty folder, prints the text on the page.
namespace afm::app {
namespace tutorial_test {

using support::FencedBlock;

std::string page() { return core::read_file(support::source("docs/tutorial.md")).value(); }

// Name of the file that a block is saved as: the last one in backticks before it.
std::string file_of(const std::string& page, const FencedBlock& block) {
  const std::size_t end = page.rfind('`', page.rfind("\n```", block.begin - 2));
  const std::size_t begin = page.rfind('`', end - 1) + 1;
  return page.substr(begin, end - begin);
}

// run.sh without its lines that install packages and build.
std::string demonstration_script() {
  std::istringstream lines(core::read_file(support::source("run.sh")).value());
  std::string script;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("scripts/", 0) != 0) script += line + "\n";
  }
  return script;
}

// A person closes the live window; the script ends it once the window has asked for a sample.
constexpr const char* kEndWindows = R"(set -eu
touchafm() {
  if [ "$1" != view ]; then command touchafm "$@"; return; fi
  command touchafm "$@" &
  for i in {1..600}; do
    if grep -q 'Choose a sample' "$output"; then break; fi
    sleep 0.1
  done
  kill $!
  wait $!
}
)";

// The page as a script: the output of its shell block number N goes to FOLDER/output-N.
std::string script_of(const std::string& page, const std::string& folder) {
  std::string script = kEndWindows;
  int number = 0;
  for (const FencedBlock& block : support::fenced_blocks(page)) {
    if (block.language == "sh") {
      script += fmt::format("output={}/output-{}\n{{\n{}}} >$output 2>&1\n", folder, ++number, block.text);
    } else if (block.language != "text") {
      script += fmt::format("cat >{} <<'END OF FILE'\n{}END OF FILE\n", file_of(page, block), block.text);
    }
  }
  return script;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// Equal words; numbers within 0.1 %, which is how far the events of a demonstration may lie from the calculated ones.
bool is_same_line(const std::string& shown, const std::string& printed) {
  std::istringstream expected(shown), actual(printed);
  std::string a, b;
  while (expected >> a) {
    if (!(actual >> b)) return false;
    char *a_end = nullptr, *b_end = nullptr;
    const double x = std::strtod(a.c_str(), &a_end), y = std::strtod(b.c_str(), &b_end);
    const bool numbers = a_end != a.c_str() && b_end != b.c_str() && std::string(a_end) == b_end;
    if (a != b && !(numbers && std::abs(x - y) <= 1e-3 * std::abs(x))) return false;
  }
  return !(actual >> b);
}

// A line of a live program's log begins with its name.
std::string without_name(const std::string& line) {
  const std::string name = "touchafm: ";
  return line.rfind(name, 0) == 0 ? line.substr(name.size()) : line;
}

// True if the output shows these lines in this order; a busy machine prints other lines between them.
bool shows(const std::string& output, const std::string& shown) {
  const std::vector<std::string> wanted = lines_of(shown);
  auto next = wanted.begin();
  for (const std::string& printed : lines_of(output)) {
    if (next != wanted.end() && is_same_line(*next, without_name(printed))) ++next;
  }
  return next == wanted.end();
}

TEST(Tutorial, PrintsWhatItShows) {
  const support::ScratchFolder folder;
  std::filesystem::create_directories(folder.file("build/release"));
  std::filesystem::create_directory_symlink(std::filesystem::path(support::touchafm()).parent_path(),
                                            folder.file("build/release/bin"));
  std::filesystem::permissions(folder.write("run.sh", demonstration_script()), std::filesystem::perms::owner_all);
  const std::string text = page();
  const std::string script = folder.write("tutorial", script_of(text, folder.path()));
  const support::VirtualDisplay display(1280, 720);
  const auto run =
      support::run_program(fmt::format("cd {} && DISPLAY={} LC_ALL=C bash {}", folder.path(), display.name(), script));

  int number = 0, shown = 0;
  std::string output;
  for (const FencedBlock& block : support::fenced_blocks(text)) {
    if (block.language == "sh") {
      output = core::read_file(folder.file(fmt::format("output-{}", ++number))).value_or("not run");
    } else if (block.language == "text") {
      ++shown;
      EXPECT_TRUE(shows(output, block.text)) << block.text << "is not what was printed:\n" << output;
    }
  }
  EXPECT_EQ(run.exit_code, 0) << run.err << output;
  EXPECT_GE(number, 10);
  EXPECT_GE(shown, 8);
}

TEST(Tutorial, NoticesAnotherNumber) {
  EXPECT_TRUE(shows("a\ntouchafm: modulus  3.001 kPa\nb\n", "modulus 3 kPa\nb\n"));
  EXPECT_FALSE(shows("b\nmodulus 3 kPa\n", "modulus 3 kPa\nb\n"));
  EXPECT_FALSE(shows("modulus  3.01 kPa\n", "modulus 3 kPa\n"));
  EXPECT_FALSE(shows("modulus  3 Pa\n", "modulus 3 kPa\n"));
  EXPECT_FALSE(shows("modulus 3 kPa or so\n", "modulus 3 kPa\n"));
}

}  // namespace tutorial_test
}  // namespace afm::app
