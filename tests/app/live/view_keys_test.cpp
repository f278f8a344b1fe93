// SPDX-License-Identifier: Apache-2.0
#include "app/live/view_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "core/whole_file.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::app {
namespace view_keys_test {

// The first column of the manual's table of keys.
std::vector<std::string> manual_keys() {
  const auto manual = core::read_file(support::source("docs/manual/demonstrate.md"));
  EXPECT_TRUE(manual.has_value());
  const std::string head = "| key | mouse | what |\n|---|---|---|\n";
  const std::size_t table = manual->find(head);
  EXPECT_NE(table, std::string::npos) << "docs/manual/demonstrate.md lacks the table " << head;
  if (table == std::string::npos) return {};
  std::istringstream lines(manual->substr(table + head.size()));
  std::vector<std::string> keys;
  for (std::string line; std::getline(lines, line) && line.starts_with("| ");) {
    std::string key = line.substr(2, line.find(" |", 2) - 2);
    keys.push_back(key.substr(0, key.find(", held")));
  }
  return keys;
}

TEST(LiveKeys, AreThoseOfTheManual) {
  std::vector<std::string> names;
  for (const LiveKey& key : live_keys()) names.emplace_back(key.name);
  EXPECT_FALSE(names.empty());
  EXPECT_EQ(manual_keys(), names);
}

TEST(LiveKeys, OfAKioskAreThoseOfTheManual) {
  const auto manual = core::read_file(support::source("docs/manual/demonstrate.md"));
  ASSERT_TRUE(manual.has_value());
  std::string one_line = *manual;
  std::replace(one_line.begin(), one_line.end(), '\n', ' ');
  EXPECT_THAT(one_line, testing::HasSubstr("only these work: " + keys_of_visitors() + "."));
}

TEST(LiveKeys, AreBoundOnce) {
  for (const LiveKey& one : live_keys()) {
    EXPECT_LE(one.key, one.last) << one.name;
    EXPECT_EQ(std::count_if(live_keys().begin(), live_keys().end(),
                            [&](const LiveKey& other) { return other.holds(one.key) || other.holds(one.last); }),
              1)
        << one.name;
  }
}

TEST(LiveKeys, FillTheListOnTheWall) {
  std::string list;
  for (const render::DataRow& row : key_list(HandSource::Mouse, false, test::english()).rows)
    list += row.name + ": " + row.value + "\n";
  for (const char* line : {"Choose a sample: 1 to 9, left click\n", "Turn-On: T, middle click\n", "Parameters: F2\n",
                           "Sources of the numbers: F3\n", "Stereo mode: next, previous: V, C\n",
                           "Eyes 1 mm closer, farther: F7, F8\n", "Quit: Esc\n"}) {
    EXPECT_THAT(list, testing::HasSubstr(line));
  }
  for (const render::DataRow& row : key_list(HandSource::Device, false, test::english()).rows)
    EXPECT_NE(row.name, "Turn-On");
}

TEST(LiveKeys, AreListedByTheLabelsOfAKeyboardThatLacksTheirLetters) {
  std::string list;
  const char* const russian = "ФИСВУАПРШОЛДЬТЩЗЙКЫЕГМЦЧНЯ";
  for (const render::DataRow& row : key_list(HandSource::Mouse, false, test::english(), WallUse::Free, russian).rows)
    list += row.name + ": " + row.value + "\n";
  for (const char* line : {"Choose a sample: 1 to 9, left click\n", "Turn-On: Е, middle click\n", "Parameters: F2\n",
                           "Stereo mode: next, previous: М, С\n", "Quit: Esc\n"}) {
    EXPECT_THAT(list, testing::HasSubstr(line));
  }
}

TEST(LiveKeys, ListThoseOfVisitorsFirst) {
  const auto visitors = key_list(HandSource::Mouse, true, test::english()).rows;
  const auto all = key_list(HandSource::Mouse, false, test::english()).rows;
  ASSERT_GT(all.size(), visitors.size());
  for (std::size_t i = 0; i < visitors.size(); ++i) EXPECT_EQ(all[i], visitors[i]) << all[i].name;
}

TEST(LiveKeys, OfAnUnattendedWindowAreThoseOfVisitors) {
  std::string list;
  for (const render::DataRow& row : key_list(HandSource::Mouse, true, test::english()).rows) list += row.name + "\n";
  for (const char* kept : {"Choose a sample", "Move the hand", "Turn-On", "Stop the force", "Start again"}) {
    EXPECT_THAT(list, testing::HasSubstr(kept));
  }
  for (const char* locked :
       {"Sound off, and on", "Quit", "Full screen", "Save the picture", "Swap the eyes", "Test pattern", "Hide"}) {
    EXPECT_THAT(list, testing::Not(testing::HasSubstr(locked)));
  }
}

}  // namespace view_keys_test
}  // namespace afm::app
