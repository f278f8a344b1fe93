// SPDX-License-Identifier: Apache-2.0
// Stereo, viewers and leftovers of ParaView's configurations.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scene/display/wall.h"
#include "scene/display/wall_doubts.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace wall_pvx_test {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kFront = "LowerLeft=\"-1.6 -0.9 -2.4\" LowerRight=\"1.6 -0.9 -2.4\" UpperRight=\"1.6 0.9 -2.4\"";
constexpr const char* kSide = "LowerLeft=\"-1.6 -0.9 2.4\" LowerRight=\"-1.6 -0.9 -2.4\" UpperRight=\"-1.6 0.9 -2.4\"";

std::string machine(const std::string& name, const std::string& attributes, const std::string& corners = kFront) {
  return "  <Machine Name=\"" + name + "\" " + attributes + " " + corners + "/>\n";
}

core::Result<Wall> load(const std::string& content) {
  const support::ScratchFolder folder;
  return load_wall(folder.write("wall.pvx", "<?xml version=\"1.0\"?>\n<pvx>\n" + content + "</pvx>\n"));
}

Wall wall_of(const std::string& content) {
  auto wall = load(content);
  EXPECT_TRUE(wall.has_value()) << wall.error().message;
  return wall ? *wall : Wall{.screens = {{}}, .outputs = {}, .viewers = {{}}};
}

TEST(PvxStereo, LeftAndRightOfOneScreenAreThePairOfDual) {
  const Wall wall =
      wall_of("<EyeSeparation Value=\"0.064\"/>\n" + machine("pl", "Geometry=\"1920x1080+0+0\" StereoType=\"Left\"") +
              machine("pr", "Geometry=\"1920x1080+1920+0\" StereoType=\"Right\""));
  ASSERT_EQ(wall.screens.size(), 1U);
  ASSERT_EQ(wall.outputs.size(), 2U);
  EXPECT_EQ(wall.outputs[0].mode, StereoMode::Dual);
  EXPECT_EQ(wall.outputs[1].mode, StereoMode::Dual);
  EXPECT_EQ(wall.outputs[0].eye, Eye::Left);
  EXPECT_EQ(wall.outputs[1].eye, Eye::Right);
  EXPECT_EQ(wall.outputs[1].rect.offset_px, glm::ivec2(1920, 0));
  EXPECT_EQ(wall.outputs[1].rect.size_px, glm::uvec2(1920, 1080));
  EXPECT_DOUBLE_EQ(wall.viewers[0].ipd_m, 0.064);
  EXPECT_THAT(notes_of(wall), IsEmpty());
}

TEST(PvxStereo, OfEachMachineIsTheModeOfItsOutput) {
  const Wall wall = wall_of(machine("a", "Geometry=\"800x600+0+0\" StereoType=\"Interlaced\"") +
                            machine("b", "Geometry=\"800x600+800+0\" StereoType=\"Crystal Eyes\"", kSide));
  ASSERT_EQ(wall.outputs.size(), 2U);
  EXPECT_EQ(wall.outputs[0].mode, StereoMode::Row);
  EXPECT_EQ(wall.outputs[1].mode, StereoMode::QuadBuffer);
  EXPECT_EQ(wall.outputs[1].screen, 1U);
}

// Desktops of two machines may have the same places: then the pair is one screen, and the places are named as ignored.
TEST(PvxStereo, WithoutPlacesOnOneDesktopStillPairsTheEyes) {
  const Wall wall = wall_of(machine("pl", "Geometry=\"1920x1080+0+0\" StereoType=\"Left\"") +
                            machine("pr", "Geometry=\"1920x1080+0+0\" StereoType=\"Right\""));
  EXPECT_EQ(wall.screens.size(), 1U);
  EXPECT_THAT(wall.outputs, IsEmpty());
  EXPECT_THAT(wall.unused, ElementsAre(AllOf(HasSubstr("line 3"), HasSubstr("\"pl\""), HasSubstr("Geometry=")),
                                       AllOf(HasSubstr("line 4"), HasSubstr("\"pr\""), HasSubstr("Geometry="))));
  EXPECT_THAT(wall_of(machine("a", "StereoType=\"Red-Blue\"")).unused,
              ElementsAre(HasSubstr("StereoType=\"Red-Blue\"")));
}

TEST(PvxViewers, OfAMachineOverrideTheGlobalSeparation) {
  const std::string viewers =
      "<EyeSeparation Value=\"0.065\"/>\n<IndependentViewers><Viewer Id=\"0\" EyeSeparation=\"0.058\"/>"
      "<Viewer Id=\"1\" EyeSeparation=\"0.062\"/></IndependentViewers>\n";
  const Wall first = wall_of(viewers + machine("a", "ViewerId=\"0\"") + machine("b", "ViewerId=\"1\"", kSide));
  EXPECT_DOUBLE_EQ(first.viewers[0].ipd_m, 0.058);
  EXPECT_THAT(first.unused, ElementsAre(AllOf(HasSubstr("Viewer 1"), HasSubstr("0.062"), HasSubstr("viewer 0")),
                                        HasSubstr("ViewerId=\"1\"")));
  EXPECT_DOUBLE_EQ(wall_of(viewers + machine("a", "ViewerId=\"1\"")).viewers[0].ipd_m, 0.062);
  EXPECT_DOUBLE_EQ(wall_of("<EyeSeparation Value=\"0.065\"/>\n" + machine("a", "")).viewers[0].ipd_m, 0.065);
  EXPECT_FALSE(
      load("<IndependentViewers><Viewer Id=\"0\" EyeSeparation=\"58\"/></IndependentViewers>" + machine("a", "")));
}

TEST(PvxFile, NamesEverythingThatIsNotTaken) {
  const Wall wall =
      wall_of("<Process Type=\"client\"/><Process Type=\"server\">\n<FullScreen Value=\"1\"/>\n" +
              machine("a", "Environment=\"DISPLAY=:0.1\" ShowBorders=\"0\" FullScreen=\"1\"") + "</Process>\n");
  EXPECT_THAT(wall.unused, Contains(AllOf(HasSubstr("line 4"), HasSubstr("FullScreen: ignored: Value=\"1\""))));
  EXPECT_THAT(wall.unused, Contains(AllOf(HasSubstr("line 5"), HasSubstr("Environment=\"DISPLAY=:0.1\""),
                                          HasSubstr("ShowBorders"), HasSubstr("FullScreen"))));
  EXPECT_THAT(wall.unused, Contains(HasSubstr("Process: ignored: Type=\"server\"")));
  EXPECT_THAT(doubts_of(wall), IsEmpty());
}

TEST(PvxFile, InAnotherUnitIsRefusedWithTheUnit) {
  const auto wall = load(
      "<Machine Name=\"a\" LowerLeft=\"-1600 -900 -2400\" LowerRight=\"1600 -900 -2400\" "
      "UpperRight=\"1600 900 -2400\"/>");
  ASSERT_FALSE(wall.has_value());
  EXPECT_EQ(wall.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(wall.error().message, AllOf(HasSubstr("3200 m x 1800 m"), HasSubstr("millimetres")));
}

TEST(PvxFile, WithThousandsOfNestedElementsIsRefused) {
  std::string deep;
  for (int i = 0; i < 5000; ++i) deep += "<a>";
  for (int i = 0; i < 5000; ++i) deep += "</a>";
  EXPECT_FALSE(load(deep + machine("a", "")).has_value());
}

TEST(PvxFaults, NameTheNumberAndTheOtherFormat) {
  EXPECT_THAT(load("<EyeSeparation Value=\"65\"/>\n" + machine("a", "")).error().message,
              HasSubstr("line 3: EyeSeparation.Value: is \"65\"; it must lie between 0.03 and 0.09, in metres"));
  const support::ScratchFolder folder;
  EXPECT_THAT(
      load_wall(folder.write("wall.xml", "<?xml version=\"1.0\"?>\n<MPCDI profile=\"2d\"></MPCDI>\n")).error().message,
      AllOf(HasSubstr("line 2: its root is <MPCDI>, not ParaView's <pvx>"), HasSubstr("wall file (TOML)")));
}

}  // namespace wall_pvx_test
}  // namespace afm::scene
