// SPDX-License-Identifier: Apache-2.0
// Each message that docs/troubleshooting.md quotes is in the sources, in the words that are printed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "architecture/production.h"
#include "architecture/prose.h"
#include "core/whole_file.h"
#include "support/places.h"

namespace afm {
namespace quoted_messages_test {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr std::string_view kAnything = "…";  // name or number in a quotation

std::string text_of(const std::string& path) { return core::read_file(support::source(path)).value(); }

// Cells of tables that are one text in backticks, of more than one word; the last column has the advice, such as
// commands.
std::vector<std::string> quotations_of(const std::string& page) {
  constexpr std::string_view kCell = "| `";
  std::vector<std::string> quotations;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| ", 0) != 0) continue;
    for (std::size_t cell = line.find(kCell); cell != std::string::npos; cell = line.find(kCell, cell + 1)) {
      const std::size_t begin = cell + kCell.size(), end = line.find('`', begin);
      const bool whole_cell = line.compare(end, 4, "` | ") == 0;
      const std::string text = line.substr(begin, end - begin);
      if (whole_cell && text.find(' ') != std::string::npos) quotations.push_back(text);
    }
  }
  return quotations;
}

bool holds(std::string_view message, std::string_view quotation) {
  std::size_t at = 0;
  while (!quotation.empty()) {
    const std::size_t end = std::min(quotation.find(kAnything), quotation.size());
    const std::size_t found = message.find(quotation.substr(0, end), at);
    if (found == std::string_view::npos) return false;
    at = found + end;
    quotation.remove_prefix(std::min(end + kAnything.size(), quotation.size()));
  }
  return true;
}

// Literals of the sources; lines of the wall's words and of the script that installs packages.
std::vector<std::string> printed_messages() {
  std::vector<std::string> messages;
  for (const std::string& folder : support::production_folders()) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(support::source(folder))) {
      const std::string ending = entry.path().extension().string();
      if (ending != ".cpp" && ending != ".h") continue;
      for (const support::Prose& message : support::messages_of(core::read_file(entry.path().string()).value())) {
        messages.push_back(message.text);
      }
    }
  }
  for (const char* file : {"assets/guidance/en.toml", "scripts/install-packages"}) {
    std::istringstream lines(text_of(file));
    for (std::string line; std::getline(lines, line);) messages.push_back(line);
  }
  return messages;
}

TEST(QuotedMessages, ArePrinted) {
  const std::vector<std::string> messages = printed_messages();
  const std::vector<std::string> quotations = quotations_of(text_of("docs/troubleshooting.md"));
  std::vector<std::string> missing;
  for (const std::string& quotation : quotations) {
    const auto is_it = [&](const std::string& message) { return holds(message, quotation); };
    if (std::none_of(messages.begin(), messages.end(), is_it)) missing.push_back(quotation);
  }
  EXPECT_GT(quotations.size(), 40U);
  EXPECT_THAT(missing, IsEmpty());
}

TEST(QuotedMessages, AreWholeCellsOfMoreThanOneWord) {
  EXPECT_THAT(
      quotations_of(
          "`not in a table`\n| `the first … of two` | `the second` | advice |\n| `word` | `a` b | `last cell` |\n"),
      ElementsAre("the first … of two", "the second"));
}

TEST(QuotedMessages, MayLeaveOutNamesAndNumbers) {
  EXPECT_TRUE(holds("cannot read {}: it ends at byte {}", "cannot read …: it ends at byte …"));
  EXPECT_TRUE(holds("cannot read {}", "cannot read"));
  EXPECT_FALSE(holds("cannot read {}: it ends", "it ends … cannot read"));
  EXPECT_FALSE(holds("cannot read {}", "cannot write …"));
}

}  // namespace quoted_messages_test
}  // namespace afm
