// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scene/wall.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* kGood = R"([[screen]]
name = "wall"
lower_left = [-1.5, 0.4, 0]
lower_right = [1.5, 0.4, 0]
upper_left = [-1.5, 2.4, 0]

[[viewer]]
name = "visitor"
ipd = "63 mm"
sweet_spot = [0, 1.6, 2.5]
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kGood;
  text.replace(text.find(from), from.size(), to);
  return text;
}

std::string error_of(const std::string& text) {
  const support::ScratchFolder folder;
  const auto wall = load_wall(folder.write("bad.toml", text));
  if (wall) return "accepted";
  EXPECT_EQ(wall.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(wall.error().message, AllOf(HasSubstr("bad.toml"), HasSubstr("line")));
  return wall.error().message;
}

TEST(WallFile, OfThePaperHasTheSizeThatThePaperGives) {
  const auto wall = load_wall(AFM_SOURCE_DIR "/assets/walls/powerwall.toml");
  ASSERT_TRUE(wall.has_value()) << wall.error().message;
  ASSERT_EQ(wall->screens.size(), 1U);
  EXPECT_NEAR(wall->screens[0].width_m(), 10.0 * 0.3048, 1e-12);
  EXPECT_NEAR(wall->screens[0].height_m(), 7.5 * 0.3048, 1e-12);
}

TEST(WallFile, IsReadAsWritten) {
  const support::ScratchFolder folder;
  const auto wall = load_wall(folder.write("good.toml", kGood));
  ASSERT_TRUE(wall.has_value()) << wall.error().message;
  EXPECT_EQ(wall->screens[0].name, "wall");
  EXPECT_EQ(wall->screens[0].upper_left, glm::dvec3(-1.5, 2.4, 0.0));
  EXPECT_DOUBLE_EQ(wall->viewers[0].ipd_m, 0.063);
  EXPECT_EQ(wall->viewers[0].sweet_spot.position_m, glm::dvec3(0.0, 1.6, 2.5));
}

TEST(WallFile, NamesLineAndKeyOfEveryMistake) {
  EXPECT_THAT(error_of(with("name = \"wall\"", "nmae = \"wall\"")), AllOf(HasSubstr("line 2"), HasSubstr("screen.nmae"), HasSubstr("unknown key")));
  EXPECT_THAT(error_of(with("lower_right = [1.5, 0.4, 0]", "lower_right = [1.5, 0.4]")), AllOf(HasSubstr("line 4"), HasSubstr("three numbers")));
  EXPECT_THAT(error_of(with("lower_right = [1.5, 0.4, 0]\n", "")), AllOf(HasSubstr("screen.lower_right"), HasSubstr("missing")));
  EXPECT_THAT(error_of(with("\"63 mm\"", "63")), AllOf(HasSubstr("line 9"), HasSubstr("viewer.ipd")));
  EXPECT_THAT(error_of(with("\"63 mm\"", "\"63\"")), AllOf(HasSubstr("line 9"), HasSubstr("mm")));
  EXPECT_THAT(error_of(with("\"63 mm\"", "\"63 cm\"")), HasSubstr("viewer.ipd"));
  EXPECT_THAT(error_of(with("\"63 mm\"", "\"6.3 m\"")), AllOf(HasSubstr("viewer.ipd"), HasSubstr("between")));
  EXPECT_THAT(error_of(with("[[viewer]]", "[viewer]")), AllOf(HasSubstr("viewer"), HasSubstr("[[viewer]]")));
  EXPECT_THAT(error_of(with("lower_left = [-1.5, 0.4, 0]", "lower_left = [-1.5, 0.4, nan]")), HasSubstr("screen.lower_left"));
  EXPECT_THAT(error_of(with("[0, 1.6, 2.5]", "[0, 1.6, ")), HasSubstr("line"));
}

TEST(WallFile, RefusesCollinearCorners) {
  EXPECT_THAT(error_of(with("upper_left = [-1.5, 2.4, 0]", "upper_left = [-2.5, 0.4, 0]")), HasSubstr("collinear"));
}

TEST(WallFile, RefusesAViewerBehindTheWall) {
  EXPECT_THAT(error_of(with("[0, 1.6, 2.5]", "[0, 1.6, -2.5]")), AllOf(HasSubstr("viewer.sweet_spot"), HasSubstr("behind")));
}

TEST(WallFile, ThatIsNotThereIsABadInputFile) {
  const auto wall = load_wall("/nowhere/wall.toml");
  ASSERT_FALSE(wall.has_value());
  EXPECT_EQ(wall.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(wall.error().message, HasSubstr("/nowhere/wall.toml"));
}

}  // namespace
}  // namespace afm::scene
