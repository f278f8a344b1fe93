// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <regex>
#include <sstream>
#include <string>

#include "core/whole_file.h"
#include "support/places.h"

// The sheet of features in docs/comparison.md adds up, and each point has its command or its reason.
namespace afm::app {
namespace feature_sheet_test {

TEST(FeatureSheet, AddsUp) {
  std::istringstream lines(core::read_file(support::source("docs/comparison.md")).value());
  const std::regex row(R"(\| (\d+) \| ([^|]+) \| ([^|]*) ?\| ([012]) \|)"), sum(R"(\| \| sum \| \| (\d+) of (\d+) \|)");
  int rows = 0, points = 0, printed = 0, most = 0;
  std::smatch found;
  for (std::string line; std::getline(lines, line);) {
    if (std::regex_match(line, found, row)) {
      EXPECT_EQ(std::stoi(found[1]), ++rows) << line;
      points += std::stoi(found[4]);
      EXPECT_EQ(found[3].length() > 0, found[4] != "0") << line;
    } else if (std::regex_match(line, found, sum)) {
      printed = std::stoi(found[1]);
      most = std::stoi(found[2]);
    }
  }
  EXPECT_EQ(rows, 35);
  EXPECT_EQ(points, printed);
  EXPECT_EQ(most, 2 * rows);
  EXPECT_GE(points, 60);
}

}  // namespace feature_sheet_test
}  // namespace afm::app
