// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "scene/display/wall.h"
#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace wall_file_test {

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
  const auto wall = load_wall(support::source("assets/walls/powerwall.toml"));
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
  EXPECT_THAT(error_of(with("name = \"wall\"", "nmae = \"wall\"")),
              AllOf(HasSubstr("line 2"), HasSubstr("screen.nmae"), HasSubstr("unknown key")));
  EXPECT_THAT(error_of(with("lower_right = [1.5, 0.4, 0]", "lower_right = [1.5, 0.4]")),
              AllOf(HasSubstr("line 4"), HasSubstr("three numbers")));
  EXPECT_THAT(error_of(with("lower_right = [1.5, 0.4, 0]\n", "")),
              AllOf(HasSubstr("screen.lower_right"), HasSubstr("missing")));
  EXPECT_THAT(error_of(with("\"63 mm\"", "63")), AllOf(HasSubstr("line 9"), HasSubstr("viewer.ipd")));
  EXPECT_THAT(error_of(with("\"63 mm\"", "\"63\"")), AllOf(HasSubstr("line 9"), HasSubstr("mm")));
  EXPECT_THAT(error_of(with("\"63 mm\"", "\"63 cm\"")), HasSubstr("viewer.ipd"));
  EXPECT_THAT(error_of(with("\"63 mm\"", "\"6.3 m\"")), AllOf(HasSubstr("viewer.ipd"), HasSubstr("between")));
  EXPECT_THAT(error_of(with("[[viewer]]", "[viewer]")), AllOf(HasSubstr("viewer"), HasSubstr("[[viewer]]")));
  EXPECT_THAT(error_of(with("lower_left = [-1.5, 0.4, 0]", "lower_left = [-1.5, 0.4, nan]")),
              HasSubstr("screen.lower_left"));
  EXPECT_THAT(error_of(with("[0, 1.6, 2.5]", "[0, 1.6, ")), HasSubstr("line"));
}

constexpr const char* kOutputs = R"(
[[output]]
name = "left projector"
screen = "wall"
mode = "dual"
eye = "left"
rect = [0, 0, 1400, 1050]

[[output]]
name = "right projector"
screen = "wall"
mode = "dual"
eye = "right"
rect = [1400, 0, 1400, 1050]
swap = true
homography = [0.5, 0, 0.25, 0, 0.5, 0.25, 0, 0, 1]
)";

std::string with_outputs(const std::string& from, const std::string& to) {
  std::string text = kGood + std::string(kOutputs);
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(WallFile, ReadsOutputs) {
  const support::ScratchFolder folder;
  const auto wall = load_wall(folder.write("wall.toml", kGood + std::string(kOutputs)));
  ASSERT_TRUE(wall.has_value()) << wall.error().message;
  ASSERT_EQ(wall->outputs.size(), 2U);
  const Output& left = wall->outputs[0];
  const Output& right = wall->outputs[1];
  EXPECT_EQ(left.name, "left projector");
  EXPECT_EQ(left.mode, StereoMode::Dual);
  EXPECT_EQ(left.eye, Eye::Left);
  EXPECT_EQ(left.order, EyeOrder::Straight);
  EXPECT_EQ(left.picture_from_output, glm::dmat3(1.0));
  EXPECT_EQ(right.eye, Eye::Right);
  EXPECT_EQ(right.order, EyeOrder::Swapped);
  EXPECT_EQ(right.rect.offset_px, glm::ivec2(1400, 0));
  EXPECT_EQ(right.rect.size_px, glm::uvec2(1400, 1050));

  // the picture's middle half of the output: its corner comes from there
  const glm::dvec3 corner = right.picture_from_output * glm::dvec3(0.25, 0.25, 1.0);
  EXPECT_NEAR(corner.x / corner.z, 0.0, 1e-12);
  EXPECT_NEAR(corner.y / corner.z, 0.0, 1e-12);
}

constexpr const char* kNodes = R"(
[[node]]
name = "left"
host = "10.0.0.2"

[[node]]
name = "right"
host = "right-machine"
)";

std::string with_nodes(const std::string& from, const std::string& to) {
  std::string text = kGood + std::string(kOutputs) + kNodes;
  text.replace(text.find("right projector\"\n"), 17, "right projector\"\nnode = \"right\"\n");
  text.replace(text.find("rect = [1400, 0, 1400, 1050]"), 28, "rect = [0, 0, 1400, 1050]");
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(WallFile, GivesOutputsToNodesWhoseDesktopsMayHaveTheSamePlaces) {
  const support::ScratchFolder folder;
  auto wall = load_wall(folder.write("nodes.toml", with_nodes("left", "left")));
  ASSERT_TRUE(wall.has_value()) << wall.error().message;
  ASSERT_EQ(wall->nodes.size(), 2U);
  EXPECT_EQ(wall->nodes[1].name, "right");
  EXPECT_EQ(wall->nodes[1].host, "right-machine");
  EXPECT_FALSE(wall->outputs[0].node);
  EXPECT_EQ(wall->outputs[1].node, 1U);
  Wall of_node = *wall;
  keep_outputs_of(1, of_node);
  ASSERT_EQ(of_node.outputs.size(), 1U);
  EXPECT_EQ(of_node.outputs[0].name, "right projector");
  ASSERT_EQ(of_node.outputs_elsewhere.size(), 1U);
  EXPECT_EQ(of_node.outputs_elsewhere[0].name, "left projector");
  keep_outputs_of(std::nullopt, *wall);
  ASSERT_EQ(wall->outputs.size(), 1U);
  EXPECT_EQ(wall->outputs[0].name, "left projector");
}

TEST(WallFile, NamesLineAndKeyOfEveryMistakeInANode) {
  const auto both = [](const char* a, const char* b) { return AllOf(HasSubstr(a), HasSubstr(b)); };
  EXPECT_THAT(error_of(with_nodes("name = \"left\"", "name = \"right\"")), both("node.name", "twice"));
  EXPECT_THAT(error_of(with_nodes("node = \"right\"", "node = \"top\"")), both("output.node", "\"top\""));
  EXPECT_THAT(error_of(with_nodes("host = \"10.0.0.2\"\n", "")), both("node.host", "missing"));
  EXPECT_THAT(error_of(with_nodes("\"10.0.0.2\"", "\"-l; reboot\"")), both("node.host", "letters"));
  EXPECT_THAT(error_of(with_nodes("name = \"left\"", "name = \"" + std::string(32, 'x') + "\"")),
              both("node.name", "longer"));
  EXPECT_THAT(error_of(with_nodes("host = \"10.0.0.2\"", "host = \"10.0.0.2\"\nuser = \"me\"")),
              both("node.user", "unknown key"));
}

TEST(WallFile, NamesLineAndKeyOfEveryMistakeInAnOutput) {
  const auto both = [](const char* a, const char* b) { return AllOf(HasSubstr(a), HasSubstr(b)); };
  EXPECT_THAT(error_of(with_outputs("screen = \"wall\"\nmode = \"dual\"", "screen = \"well\"\nmode = \"dual\"")),
              AllOf(HasSubstr("line 14"), HasSubstr("output.screen"), HasSubstr("\"well\"")));
  EXPECT_THAT(error_of(with_outputs("mode = \"dual\"", "mode = \"3d\"")),
              AllOf(HasSubstr("line 15"), both("output.mode", "anaglyph-red-cyan")));
  EXPECT_THAT(error_of(with_outputs("eye = \"left\"\n", "")), both("output.eye", "missing"));
  EXPECT_THAT(error_of(with_outputs("mode = \"dual\"", "mode = \"mono\"")), both("output.eye", "dual"));
  EXPECT_THAT(error_of(with_outputs("eye = \"left\"", "eye = \"both\"")), both("output.eye", "right"));
  EXPECT_THAT(error_of(with_outputs("eye = \"left\"", "eye = \"right\"")), both("output.eye", "already"));
  EXPECT_THAT(error_of(with_outputs("mode = \"dual\"\neye = \"left\"", "mode = \"mono\"")),
              both("output.eye", "other eye"));
  EXPECT_THAT(error_of(with_outputs("rect = [0, 0, 1400, 1050]", "")), both("output.monitor", "rect"));
  EXPECT_THAT(error_of(with_outputs("rect = [0, 0, 1400, 1050]", "rect = [0, 0, 1400, 1050]\nmonitor = \"HDMI-1\"")),
              both("output.monitor", "rect"));
  EXPECT_THAT(error_of(with_outputs("rect = [0, 0, 1400, 1050]", "rect = [0, 0, 1400]")), both("output.rect", "four"));
  EXPECT_THAT(error_of(with_outputs("rect = [0, 0, 1400, 1050]", "rect = [0, 0, 1400.5, 1050]")),
              both("output.rect", "whole"));
  EXPECT_THAT(error_of(with_outputs("rect = [0, 0, 1400, 1050]", "rect = [0, 0, 0, 1050]")),
              both("output.rect", "0 x 1050"));
  EXPECT_THAT(error_of(with_outputs("rect = [0, 0, 1400, 1050]", "rect = [0, 0, 1e300, 1050]")),
              both("output.rect", "65536"));
  EXPECT_THAT(error_of(with_outputs("rect = [0, 0, 1400, 1050]", "rect = [0, 0, 1401, 1050]")),
              both("output.rect", "overlaps"));
  EXPECT_THAT(error_of(with_outputs("left projector", "right projector")), both("output.name", "twice"));
  EXPECT_THAT(error_of(with_outputs("swap = true", "swap = 1")), both("output.swap", "true or false"));
  EXPECT_THAT(error_of(with_outputs("swap = true", "flip = true")), both("output.flip", "unknown key"));
  EXPECT_THAT(error_of(with_outputs("[0.5, 0, 0.25, 0, 0.5, 0.25, 0, 0, 1]", "[1, 0, 0, 1]")),
              both("output.homography", "nine"));
  EXPECT_THAT(error_of(with_outputs("[0.5, 0, 0.25, 0, 0.5, 0.25, 0, 0, 1]", "[1, 0, 0, 1, 0, 0, 0, 0, 1]")),
              both("output.homography", "line"));
  EXPECT_THAT(error_of(with_outputs("[0.5, 0, 0.25, 0, 0.5, 0.25, 0, 0, 1]", "[1, 0, 0, 0, 1, 0, -2, 0, 1]")),
              both("output.homography", "infinity"));
  EXPECT_THAT(error_of(with_outputs("[0.5, 0, 0.25, 0, 0.5, 0.25, 0, 0, 1]", "[-1, 0, 1, 0, 1, 0, 0, 0, 1]")),
              both("output.homography", "mirrors"));
  EXPECT_THAT(error_of(with_outputs("mode = \"dual\"\neye = \"left\"", "mode = \"frame-packed-720p\"")),
              both("output.rect", "1280 x 1470"));
  EXPECT_THAT(error_of(with("\"63 mm\"", "0.063")), both("viewer.ipd", "no unit; write a number and one of the units"));
  EXPECT_THAT(error_of("output = 3\n" + std::string(kGood)), both("output", "[[output]]"));
}

TEST(WallFile, ReadsWhoIsTheViewersHead) {
  const support::ScratchFolder folder;
  const auto wall = load_wall(
      folder.write("wall.toml", with("\"63 mm\"", "\"63 mm\"\nhead = \"dtrack:12\"\neye_from_head = [0, -0.1, 0.05]")));
  ASSERT_TRUE(wall.has_value()) << wall.error().message;
  EXPECT_EQ(wall->viewers[0].head, "dtrack:12");
  EXPECT_EQ(wall->viewers[0].eye_from_head_m, glm::dvec3(0, -0.1, 0.05));
  for (const char* wrong : {"dtrack", "dtrack:", "dtrack:x", "dtrack:-1", "dtrack:1000", "vrpn:0", "None"}) {
    EXPECT_THAT(error_of(with("\"63 mm\"", "\"63 mm\"\nhead = \"" + std::string(wrong) + "\"")),
                AllOf(HasSubstr("line 10"), HasSubstr("viewer.head"), HasSubstr(wrong)));
  }
  EXPECT_THAT(error_of(with("\"63 mm\"", "\"63 mm\"\neye_from_head = [0, -100, 0]")),
              HasSubstr("viewer.eye_from_head"));
}

// ---- ParaView's configurations ----

std::string pvx(const std::string& machines) {
  return "<?xml version=\"1.0\" ?>\n<pvx>\n  <Process Type=\"client\" />\n  <Process Type=\"server\">\n"
         "    <EyeSeparation Value=\"0.065\"/>\n" +
         machines + "  </Process>\n</pvx>\n";
}

constexpr const char* kMachine =
    "    <Machine Name=\"wall\" Environment=\"DISPLAY=:0\"\n      LowerLeft=\"-1.5 -1 -2.5\"\n      LowerRight=\"1.5 "
    "-1 -2.5\"\n"
    "      UpperRight=\"1.5 1 -2.5\" />\n";

TEST(PvxFile, GivesTheCornersOfEveryMachine) {
  const support::ScratchFolder folder;
  const auto wall = load_wall(folder.write("cave.pvx", pvx(std::string(kMachine) + kMachine)));
  ASSERT_TRUE(wall.has_value()) << wall.error().message;
  ASSERT_EQ(wall->screens.size(), 2U);
  EXPECT_EQ(wall->screens[0].name, "wall");
  EXPECT_EQ(wall->screens[1].name, "wall 2");
  EXPECT_EQ(wall->screens[0].lower_left, glm::dvec3(-1.5, -1.0, -2.5));
  EXPECT_EQ(wall->screens[0].lower_right, glm::dvec3(1.5, -1.0, -2.5));
  EXPECT_EQ(wall->screens[0].upper_left, glm::dvec3(-1.5, 1.0, -2.5));
  EXPECT_EQ(wall->viewers.at(0).ipd_m, 0.065);
  EXPECT_EQ(wall->viewers[0].sweet_spot.position_m, glm::dvec3(0.0));
}

std::string pvx_error(const std::string& text) {
  const support::ScratchFolder folder;
  const auto wall = load_wall(folder.write("bad.pvx", text));
  if (wall) return "accepted";
  EXPECT_EQ(wall.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(wall.error().message, AllOf(HasSubstr("bad.pvx"), HasSubstr("line"), ::testing::Not(HasSubstr("\n"))));
  return wall.error().message;
}

std::string machine_with(const std::string& from, const std::string& to) {
  std::string text = kMachine;
  text.replace(text.find(from), from.size(), to);
  return pvx(text);
}

TEST(PvxFile, NamesLineAndAttributeOfEveryMistake) {
  EXPECT_THAT(pvx_error(""), HasSubstr("line 1"));
  EXPECT_THAT(pvx_error("<pvx>\n<Machine\n"), HasSubstr("line"));
  EXPECT_THAT(pvx_error("<xml/>"), HasSubstr("<pvx>"));
  EXPECT_THAT(pvx_error(pvx("")), HasSubstr("no Machine"));
  EXPECT_THAT(pvx_error(machine_with("LowerLeft", "LowerLift")),
              AllOf(HasSubstr("line 6"), HasSubstr("Machine.LowerLeft"), HasSubstr("missing")));
  EXPECT_THAT(pvx_error(machine_with("-1.5 -1 -2.5", "-1.5 -1")),
              AllOf(HasSubstr("Machine.LowerLeft"), HasSubstr("three numbers")));
  EXPECT_THAT(pvx_error(machine_with("-1.5 -1 -2.5", "-1.5 nan -2.5")), HasSubstr("three numbers"));
  EXPECT_THAT(pvx_error(machine_with("-1.5 -1 -2.5", "-1.5 -1x -2.5")), HasSubstr("three numbers"));
  EXPECT_THAT(pvx_error(machine_with("-1.5 -1 -2.5", "1.5 -1 -2.5")), HasSubstr("coincide"));
  EXPECT_THAT(pvx_error("<pvx><EyeSeparation Value=\"65\"/></pvx>"), HasSubstr("EyeSeparation.Value"));
  std::string many;
  for (int i = 0; i < 65; ++i) many += kMachine;
  EXPECT_THAT(pvx_error(pvx(many)), HasSubstr("more than 64"));
}

TEST(WallFile, RefusesCollinearCorners) {
  EXPECT_THAT(error_of(with("upper_left = [-1.5, 2.4, 0]", "upper_left = [-2.5, 0.4, 0]")), HasSubstr("collinear"));
}

TEST(WallFile, RefusesAViewerBehindTheWall) {
  EXPECT_THAT(error_of(with("[0, 1.6, 2.5]", "[0, 1.6, -2.5]")),
              AllOf(HasSubstr("viewer.sweet_spot"), HasSubstr("behind")));
}

TEST(WallFile, ThatIsNotThereIsABadInputFile) {
  const auto wall = load_wall("/nowhere/wall.toml");
  ASSERT_FALSE(wall.has_value());
  EXPECT_EQ(wall.error().category, core::ErrorCategory::BadInputFile);
  EXPECT_THAT(wall.error().message, HasSubstr("/nowhere/wall.toml"));
}

}  // namespace wall_file_test
}  // namespace afm::scene
