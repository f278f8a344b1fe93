// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "app/view/view_wand.h"
#include "support/places.h"

namespace afm::app {
namespace wand_choice_test {

using ::testing::HasSubstr;
using Source = WandChoice::Source;

core::Result<WandChoice> choose(const std::string& source, const std::string& head = "") {
  return parse_wand_choice({.source = source, .file = "", .head = head});
}

TEST(WandChoice, KnowsEverySource) {
  EXPECT_EQ(choose("auto")->source, Source::Auto);
  EXPECT_EQ(choose("hid")->source, Source::Hid);
  EXPECT_EQ(choose("hid")->hid_name, "");
  EXPECT_EQ(choose("hid:SpaceMouse Pro")->source, Source::Hid);
  EXPECT_EQ(choose("hid:/dev/hidraw3")->hid_name, "/dev/hidraw3");
  EXPECT_EQ(choose("sim")->source, Source::Simulated);
  EXPECT_EQ(choose("mouse")->source, Source::Mouse);
  const auto tracker = choose("dtrack:10.0.0.7:5001");
  ASSERT_TRUE(tracker) << tracker.error().message;
  EXPECT_EQ(tracker->source, Source::Dtrack);
  EXPECT_EQ(tracker->file.dtrack->address, "10.0.0.7");
  EXPECT_EQ(tracker->file.dtrack->port, 5001);
  EXPECT_EQ(choose("dtrack")->file.dtrack->address, "127.0.0.1");
}

// A copied, unchanged file has no effect.
TEST(WandChoice, TakesATrackersAxesAsTheShippedFileDoes) {
  const auto without = choose("dtrack:127.0.0.1:5000", "dtrack:2");
  const auto with = parse_wand_choice({.file = support::source("assets/wands/dtrack.toml")});
  ASSERT_TRUE(without && with);
  EXPECT_FALSE(without->has_tracker_file);
  EXPECT_TRUE(with->has_tracker_file);
  const glm::dvec3 head(0.1, -2.5, 1.65);  // 2.5 m before the wall, 1.65 m above the floor
  const glm::dvec3 in_room = without->file.dtrack->room_from_tracker * head;
  EXPECT_LT(glm::distance(in_room, glm::dvec3(0.1, 1.65, 2.5)), 1e-9);
  EXPECT_LT(glm::distance(in_room, with->file.dtrack->room_from_tracker * head), 1e-6);
}

TEST(WandChoice, TakesTheTrackerOfTheWandFile) {
  const auto choice = parse_wand_choice({.file = support::source("assets/wands/dtrack.toml"), .head = "dtrack:4"});
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_EQ(choice->source, Source::Dtrack);
  EXPECT_EQ(choice->head_body, 4U);
  EXPECT_NE(choice->file.dtrack->room_from_tracker, glm::dquat(1.0, 0.0, 0.0, 0.0));
  const auto elsewhere =
      parse_wand_choice({.source = "dtrack:127.0.0.2:6000", .file = support::source("assets/wands/dtrack.toml")});
  EXPECT_EQ(elsewhere->file.dtrack->port, 6000);
  EXPECT_EQ(elsewhere->head_body, 0U) << "of the file";
}

TEST(WandChoice, TakesAHeadWithoutAFlystick) {
  const auto choice = choose("mouse", "dtrack:3@127.0.0.1:5002");
  ASSERT_TRUE(choice) << choice.error().message;
  EXPECT_EQ(choice->source, Source::Mouse);
  EXPECT_EQ(choice->head_body, 3U);
  EXPECT_EQ(choice->file.dtrack->port, 5002);
}

TEST(WandChoice, RefusesWhatIsNone) {
  for (const char* bad : {"", "HID", "hid:", "dtrack:", "dtrack:5000", "dtrack:1.2.3.4:", "dtrack:1.2.3.4:0",
                          "dtrack:1.2.3.4:70000", "dtrack:1.2.3.4:5x", "laser"}) {
    const auto choice = choose(bad);
    ASSERT_FALSE(choice) << bad;
    EXPECT_EQ(choice.error().category, core::ErrorCategory::WrongUsage);
    EXPECT_THAT(choice.error().message, HasSubstr("--wand: "));
  }
  for (const char* bad :
       {"dtrack", "dtrack:", "dtrack:x", "dtrack:64", "dtrack:-1", "dtrack:1@", "dtrack:1@host", "0"}) {
    const auto choice = choose("auto", bad);
    ASSERT_FALSE(choice) << bad;
    EXPECT_THAT(choice.error().message, HasSubstr("--head: "));
  }
  EXPECT_EQ(parse_wand_choice({.file = "/nowhere.toml"}).error().category, core::ErrorCategory::BadInputFile);
}

}  // namespace wand_choice_test
}  // namespace afm::app
