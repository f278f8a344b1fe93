// SPDX-License-Identifier: Apache-2.0
// Invariant: projectors that overlap add up to the picture of one; black is as bright beside an overlap as in it
#include "scene/display/blend.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "scene/display/wall.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace blend_test {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double kSum = 1e-12;

struct Rectangle {
  std::string name;
  double left, right, bottom, top;
  std::string keys{};  // keys of the screen
};

// A wall with an output for each of these screens in the plane z = 0.
std::string wall_of(const std::vector<Rectangle>& rectangles, const std::string& output_keys = {}) {
  std::string text, outputs;
  int at = 0;
  for (const Rectangle& r : rectangles) {
    text += fmt::format(
        "[[screen]]\nname = \"{}\"\nlower_left = [{}, {}, 0]\nlower_right = [{}, {}, 0]\nupper_left = [{}, {}, 0]\n{}",
        r.name, r.left, r.bottom, r.right, r.bottom, r.left, r.top, r.keys);
    outputs += fmt::format("[[output]]\nname = \"{}\"\nscreen = \"{}\"\nmode = \"mono\"\nrect = [{}, 0, 100, 100]\n{}",
                           r.name, r.name, 100 * at++, output_keys);
  }
  return text + outputs + "[[viewer]]\nname = \"v\"\nipd = \"63 mm\"\nsweet_spot = [0, 1.5, 3]\n";
}

core::Result<Wall> read(const std::string& text) {
  const support::ScratchFolder folder;
  return load_wall(folder.write("wall.toml", text));
}

std::string error_of(const std::string& text) {
  const auto wall = read(text);
  if (wall) return "accepted";
  EXPECT_THAT(wall.error().message, AllOf(HasSubstr("wall.toml"), HasSubstr("line")));
  return wall.error().message;
}

const Rectangle kLeft{"left", -2.0, 0.25, 0.5, 2.0}, kRight{"right", -0.25, 2.0, 0.5, 2.0};

Rectangle with_keys(Rectangle rectangle, const std::string& keys) {
  rectangle.keys = keys;
  return rectangle;
}

// Of all outputs together at a place of the wall: weights, light of black with what raises it, share left to the
// picture. Nothing where no screen is.
struct Together {
  double share = 0, black = 0;
  int screens = 0;
};
Together together(const Wall& wall, const glm::dvec2& place) {
  Together sum;
  for (const Output& output : wall.outputs) {
    const Screen& screen = wall.screens[output.screen];
    const glm::dvec2 uv((place.x - screen.lower_left.x) / screen.width_m(),
                        (screen.upper_left.y - place.y) / screen.height_m());
    if (uv.x < 0.0 || uv.y < 0.0 || uv.x > 1.0 || uv.y > 1.0) continue;
    ++sum.screens;
    if (!output.blend) {
      sum.share += 1.0;
      continue;
    }
    const Blend::Place at = output.blend->at(uv);
    const double share = at.own / at.all;
    sum.share += share;
    sum.black += output.blend->fields.front().black + share * (output.blend->brightest_black - at.black);
  }
  return sum;
}

// Everywhere the outputs add up to one picture over one black.
void expect_one_picture(const std::string& text, double black) {
  const auto wall = read(text);
  ASSERT_TRUE(wall) << wall.error().message;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(-4.0, 4.0), y(0.0, 4.0);
  int covered = 0, overlapped = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec2 place{x(random), y(random)};
    const Together sum = together(*wall, place);
    if (sum.screens == 0) continue;
    ++covered;
    overlapped += sum.screens > 1 ? 1 : 0;
    ASSERT_NEAR(sum.share, 1.0, kSum) << place.x << ", " << place.y;
    ASSERT_NEAR(sum.black, black, kSum) << place.x << ", " << place.y;
  }
  EXPECT_GT(covered, 1000);
  EXPECT_GT(overlapped, 50);
}

TEST(BlendOfAWall, IsTheOverlapOfItsScreens) {
  const Wall wall = read(wall_of({kLeft, kRight})).value();
  ASSERT_TRUE(wall.screens[0].blend && wall.screens[1].blend);
  const ScreenBlend &left = *wall.screens[0].blend, &right = *wall.screens[1].blend;
  EXPECT_EQ(left.neighbours, std::vector<std::size_t>{1});
  EXPECT_EQ(right.neighbours, std::vector<std::size_t>{0});
  EXPECT_DOUBLE_EQ(left.ramp(ScreenEdge::Right).width_m, 0.5);
  EXPECT_EQ(left.ramp(ScreenEdge::Right).begin_m, 0.0);
  EXPECT_EQ(left.ramp(ScreenEdge::Left), EdgeRamp{});
  EXPECT_EQ(left.ramp(ScreenEdge::Top), EdgeRamp{});
  EXPECT_DOUBLE_EQ(right.ramp(ScreenEdge::Left).width_m, 0.5);
  EXPECT_EQ(left.origin, right.origin);
  EXPECT_EQ(left.origin, wall.screens[0].center());
  EXPECT_FALSE(wall.outputs[0].blend->gamma);

  // half of the way through the overlap each shows half
  const Blend::Place middle = wall.outputs[0].blend->at({2.0 / 2.25, 0.3});
  EXPECT_NEAR(middle.own / middle.all, 0.5, 1e-12);
  EXPECT_EQ(wall.outputs[0].blend->at({0.5, 0.3}).own, 1.0);
}

TEST(BlendOfAWall, AddsUpToOnePicture) {
  expect_one_picture(wall_of({kLeft, kRight}), 0.0);
  expect_one_picture(wall_of({kRight, kLeft}, "gamma = 2.2\nblack_level = 0.01\n"), 0.02);
  // a narrower ramp in the middle of the overlap, said on either side
  expect_one_picture(wall_of({with_keys(kLeft, "blend_right = \"200 mm\"\n"), kRight}), 0.0);
  expect_one_picture(wall_of({kLeft, with_keys(kRight, "blend_left = \"10 mm\"\n")}), 0.0);
  expect_one_picture(wall_of({{"upper", -1.0, 1.0, 1.5, 3.0}, {"lower", -1.0, 1.0, 0.2, 1.9}}), 0.0);
  expect_one_picture(
      wall_of({{"a", -3, -1, 0.5, 2}, {"b", -1.4, 0.6, 0.5, 2}, {"c", 0.2, 2.2, 0.5, 2}}, "black_level = 0.002\n"),
      0.004);
  // a third that reaches over the second into the first
  expect_one_picture(
      wall_of({{"a", -3, 0, 0.5, 2}, {"b", -1, 1, 0.5, 2}, {"c", -0.5, 3, 0.5, 2}}, "black_level = 0.002\n"), 0.006);
  expect_one_picture(
      wall_of({{"a", -2, 0.2, 1.4, 3}, {"b", -0.2, 2, 1.4, 3}, {"c", -2, 0.2, 0, 1.6}, {"d", -0.2, 2, 0, 1.6}},
              "black_level = 0.01\n"),
      0.04);
}

TEST(BlendOfAWall, AddsUpWhereScreensAreNoGrid) {
  // measured by tape: like bricks, at a corner only, and of different heights
  expect_one_picture(wall_of({{"a", -2, 0.203, 1.4, 3},
                              {"b", -0.2, 2, 1.398, 3.004},
                              {"c", -2.001, 0.198, 0, 1.602},
                              {"d", -0.196, 2, 0.002, 1.6}}),
                     0.0);
  expect_one_picture(wall_of({{"a", -2, 0, 0.2, 1.8}, {"b", -0.3, 2, 0.2, 1.8}, {"c", -1.2, 1.2, 1.5, 3.2}}), 0.0);
  expect_one_picture(wall_of({{"a", -2, 0.2, 0.2, 2}, {"b", -0.2, 2, 1.7, 3.5}}), 0.0);
  expect_one_picture(wall_of({{"a", -2, 0.2, 0.2, 3}, {"b", -0.2, 2, 1.0, 2.0}}, "black_level = 0.01\n"), 0.02);
}

TEST(BlendOfAWall, LeavesAloneWhatOnlyTouchesLiesInsideOrLiesElsewhere) {
  const auto unblended = [](const std::string& text) {
    const auto wall = read(text);
    EXPECT_TRUE(wall) << wall.error().message;
    if (!wall) return;
    for (const Screen& screen : wall->screens) EXPECT_FALSE(screen.blend) << screen.name;
    for (const Output& output : wall->outputs) EXPECT_FALSE(output.blend) << output.name;
  };
  unblended(wall_of({{"a", -2, 0, 0.5, 2}, {"b", 0, 2, 0.5, 2}}));
  unblended(wall_of({{"a", -2, 0.004, 0.5, 2}, {"b", -0.004, 2, 0.5, 2}}));  // tiles measured badly
  unblended(wall_of({{"a", -2, 2, 0.5, 2}, {"b", -2, 2, 0.5, 2}}));
  unblended(wall_of({{"a", -2, 2, 0.5, 2.5}, {"inset", -1, 1, 1, 2}}));
  std::string behind = wall_of({kLeft, kRight});
  std::size_t at = 0;
  for (int corner = 0; corner < 3; ++corner) {
    at = behind.find(", 0]", at) + 1;
    behind.replace(at, 3, " -0.1]");
  }
  unblended(behind);
}

TEST(BlendOfAWall, NamesLineAndKeyOfEveryMistake) {
  const auto left = [](const std::string& keys) { return wall_of({with_keys(kLeft, keys), kRight}); };
  EXPECT_THAT(error_of(left("blend_left = \"200 mm\"\n")),
              AllOf(HasSubstr("line 6"), HasSubstr("screen.blend_left"), HasSubstr("no screen overlaps this edge")));
  EXPECT_THAT(error_of(left("blend_right = \"600 mm\"\n")),
              AllOf(HasSubstr("line 6"), HasSubstr("is 600 mm"), HasSubstr("\"right\""), HasSubstr("500 mm only")));
  EXPECT_THAT(error_of(left("blend_right = \"1 mm\"\n")), AllOf(HasSubstr("line 6"), HasSubstr("between 10 mm")));
  EXPECT_THAT(error_of(left("blend_right = \"-0.2 m\"\n")), HasSubstr("screen.blend_right"));
  EXPECT_THAT(error_of(left("blend_right = 0.2\n")), AllOf(HasSubstr("line 6"), HasSubstr("screen.blend_right")));
  EXPECT_THAT(error_of(wall_of(
                  {with_keys(kLeft, "blend_right = \"200 mm\"\n"), with_keys(kRight, "blend_left = \"300 mm\"\n")})),
              AllOf(HasSubstr("line 6"), HasSubstr("same width")));
  const auto output = [](const std::string& keys) { return wall_of({kLeft, kRight}, keys); };
  for (const char* gamma : {"0.9", "4.1", "nan", "\"2.2\"", "-2"}) {
    EXPECT_THAT(error_of(output("gamma = " + std::string(gamma) + "\n")),
                AllOf(HasSubstr("line 16"), HasSubstr("output.gamma"), HasSubstr("from 1 to 4")))
        << gamma;
  }
  for (const char* black : {"-0.001", "0.06", "inf", "true"}) {
    EXPECT_THAT(error_of(output("black_level = " + std::string(black) + "\n")),
                AllOf(HasSubstr("line 16"), HasSubstr("output.black_level"), HasSubstr("from 0 to 0.05")))
        << black;
  }
  const Rectangle alone{"alone", -2, 2, 0.5, 2};
  EXPECT_THAT(error_of(wall_of({alone}, "gamma = 2.2\n")),
              AllOf(HasSubstr("line 11"), HasSubstr("output.gamma"), HasSubstr("only where another screen overlaps")));
  EXPECT_THAT(error_of(wall_of({alone}, "black_level = 0.01\n")), HasSubstr("output.black_level"));
}

TEST(BlendOfAWall, NeedsAProjectorForEveryScreenOfTheOverlapAndAlikeKeys) {
  std::string text = wall_of({kLeft, kRight});
  const std::size_t second = text.rfind("[[output]]");
  const std::size_t viewer = text.find("[[viewer]]");
  EXPECT_THAT(error_of(text.substr(0, second) + text.substr(viewer)),
              AllOf(HasSubstr("output.screen"), HasSubstr("\"right\", which no output shows")));
  text.insert(second, "black_level = 0.01\n");
  EXPECT_THAT(error_of(text), AllOf(HasSubstr("output.black_level"), HasSubstr("is missing")));
  std::string turned = wall_of({kLeft, kRight});
  turned.insert(turned.rfind(", 0]\nupper_left"), "3");
  EXPECT_THAT(error_of(turned), AllOf(HasSubstr("screen.lower_right"), HasSubstr("30 mm higher")));
  std::vector<Rectangle> many;
  for (int i = 0; i < 10; ++i) many.push_back({fmt::format("s{}", i), -3 + 0.1 * i, 1 + 0.1 * i, 0.5, 2});
  EXPECT_THAT(error_of(wall_of(many)), AllOf(HasSubstr("screen.name"), HasSubstr("at most 8")));
}

// Two widths, each valid for its edge, on screens that do not form a grid.
TEST(BlendOfAWall, RefusesRampsThatLeaveADarkPlace) {
  EXPECT_THAT(error_of(wall_of({with_keys({"a", -2, 0, 0.2, 1.8}, "blend_top = \"50 mm\"\nblend_right = \"50 mm\"\n"),
                                {"b", -0.3, 2, 0.2, 1.8},
                                {"c", -1.2, 1.2, 1.5, 3.2}})),
              AllOf(HasSubstr("blend_"), HasSubstr("dark place")));
}

TEST(BlendOfAWall, IsOfOneEyeInAPairOfProjectors) {
  std::string text = wall_of({kLeft, kRight});
  text.erase(text.find("[[output]]"), text.find("[[viewer]]") - text.find("[[output]]"));
  int at = 0;
  for (const char* screen : {"left", "right"}) {
    for (const char* eye : {"left", "right"}) {
      text += fmt::format(
          "[[output]]\nname = \"{0} {1}\"\nscreen = \"{0}\"\nmode = \"dual\"\neye = \"{1}\"\nrect = [{2}, 0, 100, "
          "100]\n"
          "black_level = {3}\n",
          screen, eye, 100 * at++, std::string_view(eye) == "left" ? 0.01 : 0.02);
    }
  }
  const auto wall = read(text);
  ASSERT_TRUE(wall) << wall.error().message;
  EXPECT_DOUBLE_EQ(wall->outputs[0].blend->brightest_black, 0.02);
  EXPECT_DOUBLE_EQ(wall->outputs[1].blend->brightest_black, 0.04);
  EXPECT_DOUBLE_EQ(wall->outputs[3].blend->darkest_black, 0.02);
}

TEST(BlendOfAWall, ReadsTheWarpMeshBesideTheWallFile) {
  const support::ScratchFolder folder;
  folder.write("bent.data", "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n");
  const Rectangle alone{"alone", -2, 2, 0.5, 2};
  const auto with = [&](const std::string& keys) {
    return load_wall(folder.write("wall.toml", wall_of({alone}, keys)));
  };
  const auto wall = with("warp_mesh = \"bent.data\"\n");
  ASSERT_TRUE(wall) << wall.error().message;
  ASSERT_TRUE(wall->outputs[0].warp);
  EXPECT_EQ(wall->outputs[0].warp->columns, 2U);
  EXPECT_THAT(with("warp_mesh = \"none.data\"\n").error().message,
              AllOf(HasSubstr("line 11"), HasSubstr("output.warp_mesh"), HasSubstr("none.data")));
  folder.write("bent.data", "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0\n");
  EXPECT_THAT(with("warp_mesh = \"bent.data\"\n").error().message,
              AllOf(HasSubstr("wall.toml"), HasSubstr("output.warp_mesh"), HasSubstr("bent.data: line 4")));
  EXPECT_THAT(with("warp_mesh = \"bent.data\"\nhomography = [1, 0, 0, 0, 1, 0, 0, 0, 1]\n").error().message,
              HasSubstr("either a homography or a warp mesh"));
  EXPECT_THAT(with("warp_mesh = 3\n").error().message, HasSubstr("output.warp_mesh"));
}

}  // namespace blend_test
}  // namespace afm::scene
