// SPDX-License-Identifier: Apache-2.0
// Walls as people bring them: in other units, axes and turns. A wall that is meant as it is written has no doubt.
#include "scene/display/wall_doubts.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <string>
#include <vector>

#include "support/places.h"
#include "support/scratch_folder.h"

namespace afm::scene {
namespace wall_doubts_test {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

struct Written {
  glm::dvec3 lower_left{-1.6, 0.5, 0}, lower_right{1.6, 0.5, 0}, upper_left{-1.6, 2.3, 0}, head{0, 1.65, 2.4};
  std::string orientation{};  // numbers in the file's order; empty: not given
  std::string more{};         // other tables before the viewer
  std::string viewers{};      // tables after the viewer

  Written scaled(double screens, double head_scale) const {
    Written other = *this;
    for (glm::dvec3* corner : {&other.lower_left, &other.lower_right, &other.upper_left}) *corner *= screens;
    other.head *= head_scale;
    return other;
  }
  std::string text() const {
    const auto point = [](const glm::dvec3& v) { return fmt::format("[{:.6f}, {:.6f}, {:.6f}]", v.x, v.y, v.z); };
    return fmt::format(
        "[[screen]]\nname = \"wall\"\nlower_left = {}\nlower_right = {}\nupper_left = {}\n{}\n"
        "[[viewer]]\nname = \"guest\"\nipd = \"63 mm\"\nsweet_spot = {}\n{}{}",
        point(lower_left), point(lower_right), point(upper_left), more, point(head),
        orientation.empty() ? "" : "sweet_spot_orientation = " + orientation + "\n", viewers);
  }
  core::Result<Wall> wall() const {
    const support::ScratchFolder folder;
    return load_wall(folder.write("wall.toml", text()));
  }
  std::vector<std::string> doubts() const {
    const auto read = wall();
    EXPECT_TRUE(read.has_value()) << read.error().message;
    return read ? doubts_of(*read) : std::vector<std::string>{read.error().message};
  }
  std::string refusal() const {
    const auto read = wall();
    if (read) return "accepted";
    EXPECT_EQ(read.error().category, core::ErrorCategory::BadInputFile);
    return read.error().message;
  }
};

Written desk() { return {{-0.2985, 0.12, 0}, {0.2985, 0.12, 0}, {-0.2985, 0.456, 0}, {0, 0.34, 0.65}, {}, {}, {}}; }

// Every preset is intended as written.
TEST(WallDoubts, ArisesForNoPreset) {
  std::size_t presets = 0;
  for (const auto& entry : std::filesystem::directory_iterator(support::source("assets/walls"))) {
    if (entry.path().extension() != ".toml") continue;
    const auto wall = load_wall(entry.path().string());
    ASSERT_TRUE(wall.has_value()) << wall.error().message;
    EXPECT_THAT(notes_of(*wall), IsEmpty()) << entry.path();
    ++presets;
  }
  EXPECT_GE(presets, 11U);
  EXPECT_THAT(Written().doubts(), IsEmpty());
}

// A second [[screen]] that was copied and not changed shows the same picture again.
TEST(WallDoubts, NameTwoScreensAtOnePlaceUnlessTheyAreAPairOfEyes) {
  const auto second = [](double right_m, const std::string& modes) {
    Written wall;
    wall.more = fmt::format(
        "[[screen]]\nname = \"copy\"\nlower_left = [{:.3f}, 0.5, 0]\nlower_right = [{:.3f}, 0.5, 0]\n"
        "upper_left = [{:.3f}, 2.3, 0]\n{}",
        right_m - 1.6, right_m + 1.6, right_m - 1.6, modes);
    return wall.doubts();
  };
  const auto output = [](const char* screen, const char* mode, int x) {
    return fmt::format("[[output]]\nname = \"{0}\"\nscreen = \"{0}\"\nmode = \"{1}\"\nrect = [{2}, 0, 1600, 900]\n",
                       screen, mode, x);
  };
  for (const double right_m : {0.0, 0.02}) {
    EXPECT_THAT(second(right_m, ""), ElementsAre(AllOf(HasSubstr("screens \"wall\" and \"copy\" are at one place"),
                                                       HasSubstr(fmt::format("{:.0f} mm apart", right_m * 1e3)),
                                                       HasSubstr("give both outputs the same screen"))));
  }
  EXPECT_THAT(second(3.2, ""), IsEmpty());
  EXPECT_THAT(second(0.0, output("wall", "left", 0) + output("copy", "right", 1600)), IsEmpty());
  EXPECT_THAT(second(0.0, output("wall", "mono", 0) + output("copy", "mono", 1600)), SizeIs(1));
  // a screen without an output, or with one for one eye only
  EXPECT_THAT(second(3.2, output("wall", "mono", 0)), ElementsAre(HasSubstr("screen \"copy\" has no output")));
  EXPECT_THAT(second(3.2, output("wall", "left", 0) + output("copy", "row", 1600)),
              ElementsAre(HasSubstr("screen \"wall\" has no output for the right eye")));
  EXPECT_THAT(second(3.2, "[[node]]\nname = \"left\"\nhost = \"10.0.0.2\"\n" + output("wall", "mono", 0) +
                              output("copy", "mono", 1600)),
              ElementsAre(HasSubstr("node \"left\" has no output")));
}

TEST(WallDoubts, RefuseAWallInAnotherUnitAndNameTheUnit) {
  const auto refused = [](double units_per_m, const char* unit) {
    const std::string refusal = Written().scaled(units_per_m, units_per_m).refusal();
    EXPECT_THAT(refusal, AllOf(HasSubstr("line 3"), HasSubstr("screen.lower_left"), HasSubstr(unit),
                               HasSubstr("3.20 m x 1.80 m with the head 2.40 m in front of it")));
  };
  refused(1e3, "as millimetres");
  refused(1e2, "as centimetres");
  refused(1.0 / 0.0254, "as inches");
  EXPECT_THAT(Written().scaled(1e3, 1e3).refusal(), HasSubstr("3200 m x 1800 m"));
  EXPECT_THAT(desk().scaled(1e3, 1e3).refusal(), HasSubstr("as millimetres"));
}

TEST(WallDoubts, NameTheUnitWhereTheWallCouldBeInMetres) {
  EXPECT_THAT(
      Written().scaled(1.0 / 0.3048, 1.0 / 0.3048).doubts(),
      ElementsAre(AllOf(HasSubstr("viewer \"guest\""), HasSubstr("5.41 m above the floor"), HasSubstr("as feet"))));
  EXPECT_THAT(desk().scaled(1.0 / 0.0254, 1.0 / 0.0254).doubts(), ElementsAre(HasSubstr("as inches")));
  EXPECT_THAT(desk().scaled(1e2, 1e2).doubts(), ElementsAre(HasSubstr("as centimetres")));
}

TEST(WallDoubts, NameTheUnitOfCornersOrHeadAlone) {
  EXPECT_THAT(Written().scaled(1.0, 1e3).refusal(),
              AllOf(HasSubstr("line 10"), HasSubstr("viewer.sweet_spot"), HasSubstr("2400 m in front"),
                    HasSubstr("sweet_spot in millimetres"), HasSubstr("2.40 m in front")));
  EXPECT_THAT(Written().scaled(1.0, 1e2).refusal(), HasSubstr("sweet_spot in centimetres"));
  EXPECT_THAT(Written().scaled(1.0, 1.0 / 0.0254).refusal(), HasSubstr("sweet_spot in inches"));
  EXPECT_THAT(Written().scaled(1.0, 1.0 / 0.3048).doubts(), ElementsAre(HasSubstr("sweet_spot in feet")));
  EXPECT_THAT(Written().scaled(1e3, 1.0).refusal(), HasSubstr("corners in millimetres and sweet_spot in metres"));
}

// A person who adds a screen may measure it in another unit than the first.
TEST(WallDoubts, NameTheUnitOfOneScreenAmongOthers) {
  Written both;
  const auto second = [&](const char* corners) {
    both.more = fmt::format("[[screen]]\nname = \"right\"\n{}\n", corners);
    return both.refusal();
  };
  EXPECT_THAT(
      second("lower_left = [160, 50, 0]\nlower_right = [160, 50, 240]\nupper_left = [160, 230, 0]"),
      AllOf(HasSubstr("line 8: screen.lower_left"), HasSubstr("240 m x 180 m, beside screen \"wall\" of 3.20 m"),
            HasSubstr("with the corners of this screen in centimetres, it would be 2.40 m x 1.80 m"),
            Not(HasSubstr("sweet_spot"))));
  EXPECT_THAT(second("lower_left = [1600, 500, 0]\nlower_right = [1600, 500, 2400]\nupper_left = [1600, 2300, 0]"),
              HasSubstr("with the corners of this screen in millimetres, it would be 2.40 m x 1.80 m"));
}

// Coordinates of a survey: in floats, neighbouring points would fall together.
TEST(WallDoubts, RefuseAWallFarFromTheOriginOfItsRoom) {
  Written surveyed;
  for (glm::dvec3* point : {&surveyed.lower_left, &surveyed.lower_right, &surveyed.upper_left, &surveyed.head}) {
    *point += glm::dvec3(448262.0, 0.0, -5411932.0);
  }
  EXPECT_THAT(surveyed.refusal(), AllOf(HasSubstr("line 3"), HasSubstr("5430465 m from the room's origin"),
                                        HasSubstr("subtract one point of the room")));
}

// Several units may fit; the one that was written is among those named, of a desk, a television and a powerwall.
TEST(WallDoubts, HaveTheWrittenUnitAmongThoseThatTheyName) {
  const Written television{{-0.5, 0.9, 0}, {0.5, 0.9, 0}, {-0.5, 1.4625, 0}, {0, 1.2, 1.5}, {}, {}, {}};
  const Written powerwall{{-3, 0.3, 0}, {3, 0.3, 0}, {-3, 3.7, 0}, {0, 1.7, 4}, {}, {}, {}};
  const auto said = [](const Written& written) {
    const auto wall = written.wall();
    return wall ? fmt::format("{}", fmt::join(doubts_of(*wall), "\n")) : wall.error().message;
  };
  constexpr double kFeet = 1.0 / 0.3048, kInches = 1.0 / 0.0254;
  for (const Written& written : {television, powerwall, desk()}) {
    for (const auto& [per_m, unit] : {std::pair{1e3, "millimetres"}, {1e2, "centimetres"}, {kInches, "inches"}}) {
      EXPECT_THAT(said(written.scaled(per_m, per_m)), HasSubstr(fmt::format("as {}, the screen", unit)));
      EXPECT_THAT(said(written.scaled(1.0, per_m)), HasSubstr(fmt::format("sweet_spot in {}, the head", unit)));
      EXPECT_THAT(said(written.scaled(per_m, 1.0)), HasSubstr(fmt::format("corners in {} and sweet_spot in", unit)));
    }
  }
  EXPECT_THAT(said(television.scaled(kFeet, kFeet)), HasSubstr("as feet, the screen would be 1.00 m x 0.56 m"));
  EXPECT_THAT(said(powerwall.scaled(10.0, 1.0)),
              HasSubstr("4000 mm in front of screen \"wall\", which is 60.00 m wide: "
                        "lengths are in metres: with the corners in"));
}

TEST(WallDoubts, NameTheUnitOfALeftHandedRoom) {
  Written unity = Written().scaled(1e3, 1e3);
  unity.head.z = -unity.head.z;
  EXPECT_THAT(unity.refusal(), HasSubstr("as millimetres, the screen would be 3.20 m x 1.80 m with the head 2.40 m "
                                         "behind it"));
}

TEST(WallDoubts, NameTheTurnOfTheAxisThatPointsUp) {
  Written x_up;
  for (glm::dvec3* point : {&x_up.lower_left, &x_up.lower_right, &x_up.upper_left, &x_up.head}) {
    *point = {point->y, -point->x, point->z};
  }
  EXPECT_THAT(x_up.doubts(),
              ElementsAre(HasSubstr("if +x points up in your room, write each point x, y, z as [-y, x, z]")));
  Written x_down;
  for (glm::dvec3* point : {&x_down.lower_left, &x_down.lower_right, &x_down.upper_left, &x_down.head}) {
    *point = {-point->y, point->x, point->z};
  }
  EXPECT_THAT(x_down.doubts(),
              ElementsAre(HasSubstr("if -x points up in your room, write each point x, y, z as [y, -x, z]")));
}

TEST(WallDoubts, AreSaidOfEveryViewer) {
  Written two;
  two.viewers = "[[viewer]]\nname = \"second\"\nipd = \"60 mm\"\nsweet_spot = [0, 1650, 2400]\n";
  EXPECT_THAT(two.refusal(), AllOf(HasSubstr("line 14"), HasSubstr("sweet_spot in millimetres")));
  two.viewers =
      "[[viewer]]\nname = \"second\"\nipd = \"60 mm\"\nsweet_spot = [0, 1.65, 2.4]\n"
      "sweet_spot_orientation = [0, 1, 0, 0]\n";
  EXPECT_THAT(two.doubts(), ElementsAre(AllOf(HasSubstr("viewer \"second\""), HasSubstr("away"))));
}

TEST(WallDoubts, KnowAHeadThatIsTooNearOrTooFar) {
  Written near;
  near.head = {0, 1.65, 0.076};
  EXPECT_THAT(near.doubts(),
              ElementsAre(AllOf(HasSubstr("76 mm in front of screen \"wall\""), HasSubstr("3.20 m wide"))));
  Written phone{{-0.03, 1.2, 0}, {0.03, 1.2, 0}, {-0.03, 1.3, 0}, {0, 1.65, 5}, {}, {}, {}};
  EXPECT_THAT(phone.doubts(), ElementsAre(HasSubstr("5.00 m in front")));
  Written lecture;  // seat in the last row of a lecture hall
  lecture.head = {0, 2.8, 30};
  EXPECT_THAT(lecture.doubts(), IsEmpty());
}

TEST(WallDoubts, KnowAHeadBesideTheWall) {
  Written wall;
  wall.head = {10.0, 1.65, 0.5};
  EXPECT_THAT(wall.doubts(), ElementsAre(AllOf(HasSubstr("0.50 m in front of screen \"wall\""), HasSubstr("strip"))));
  wall.head = {2.5, 1.65, 1.0};
  EXPECT_THAT(wall.doubts(), IsEmpty());
}

TEST(WallDoubts, KnowAHeadThatNearlyTouchesASmallScreen) {
  const Written wall = Written().scaled(0.0125, 0.0125);
  EXPECT_THAT(wall.doubts(), ElementsAre(HasSubstr("the head is 30 mm in front of screen \"wall\"")));
}

TEST(WallDoubts, RefuseAnEyeInOrBehindAScreenWithItsDistance) {
  Written wall;
  wall.head.z = 0.004;
  EXPECT_THAT(wall.refusal(), HasSubstr("is 0.004 m in front of the screen; it must be at least 10 mm in front"));
  wall.head.z = -2.0;
  EXPECT_THAT(wall.refusal(), HasSubstr("is 2.000 m behind the screen"));
}

TEST(WallDoubts, KnowAPictureThatIsUpsideDown) {
  Written hanging;
  hanging.lower_left = {1.6, 2.3, 0};
  hanging.lower_right = {-1.6, 2.3, 0};
  hanging.upper_left = {1.6, 0.5, 0};
  EXPECT_THAT(hanging.doubts(), ElementsAre(AllOf(HasSubstr("screen \"wall\""), HasSubstr("upper edge is below"),
                                                  HasSubstr("upside down"))));
}

// The same wall in a room whose z points up, seen from each side, and a picture on its side.
TEST(WallDoubts, KnowARoomWhoseZPointsUp) {
  const auto turned = [](const glm::dmat3& room_from_usual) {
    Written other;
    for (glm::dvec3* point : {&other.lower_left, &other.lower_right, &other.upper_left, &other.head}) {
      *point = room_from_usual * *point;
    }
    return other.doubts();
  };
  const glm::dvec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const auto is_said = [&](const glm::dvec3& right, const glm::dvec3& back) {
    const auto doubts = turned(glm::dmat3(right, z, back));
    ASSERT_FALSE(doubts.empty());
    EXPECT_THAT(doubts.front(), AllOf(HasSubstr("upper edge points along +z"), HasSubstr("[x, z, -y]")));
  };
  is_said(x, -y);   // view along y, as in Blender's and Vicon's rooms
  is_said(-y, -x);  // view along x, as in ROS
  is_said(-x, y);
  is_said(y, x);
  Written on_its_side;
  on_its_side.lower_left = {1.6, 0.5, 0};
  on_its_side.lower_right = {1.6, 3.7, 0};
  on_its_side.upper_left = {-0.2, 0.5, 0};
  EXPECT_THAT(on_its_side.doubts(), ElementsAre(HasSubstr("upper edge points along -x")));
}

TEST(WallDoubts, ExceptFloorsCeilingsAndTables) {
  const Written floor{{-1.5, 0, 1}, {1.5, 0, 1}, {-1.5, 0, -1}, {0, 1.65, 1.3}, {}, {}, {}};
  EXPECT_THAT(floor.doubts(), IsEmpty());
  Written from_behind = floor;  // viewer at the other side of a table
  from_behind.orientation = "[0, 1, 0, 0]";
  from_behind.head.z = -1.3;
  EXPECT_THAT(from_behind.doubts(), IsEmpty());
  const Written ceiling{{-1.6, 2.8, -1}, {1.6, 2.8, -1}, {-1.6, 2.8, 1}, {0, 1.2, 0}, {}, {}, {}};
  EXPECT_THAT(ceiling.doubts(), IsEmpty());
  const Written drafting_table{{-0.6, 0.8, 0}, {0.6, 0.8, 0}, {-0.6, 1.2, -0.7}, {0, 1.6, 0.6}, {}, {}, {}};
  EXPECT_THAT(drafting_table.doubts(), IsEmpty());

  // a CAVE around the room's origin, ceiling and floor too
  Written cave{{-1.5, -1.5, -1.5}, {1.5, -1.5, -1.5}, {-1.5, 1.5, -1.5}, {0, 0, 0}, {}, {}, {}};
  cave.more =
      "[[screen]]\nname = \"ceiling\"\nlower_left = [-1.5, 1.5, -1.5]\nlower_right = [1.5, 1.5, -1.5]\n"
      "upper_left = [-1.5, 1.5, 1.5]\n"
      "[[screen]]\nname = \"floor\"\nlower_left = [-1.5, -1.5, 1.5]\nlower_right = [1.5, -1.5, 1.5]\n"
      "upper_left = [-1.5, -1.5, -1.5]\n"
      "[[screen]]\nname = \"left\"\nlower_left = [-1.5, -1.5, 1.5]\nlower_right = [-1.5, -1.5, -1.5]\n"
      "upper_left = [-1.5, 1.5, 1.5]\n";
  EXPECT_THAT(cave.doubts(), IsEmpty());
}

TEST(WallDoubts, KnowAHeadBelowTheFloor) {
  Written mixed;  // head of a room with z up, in front of a screen of one with y up
  mixed.head = {0, -2.5, 1.65};
  EXPECT_THAT(mixed.doubts(), ElementsAre(AllOf(HasSubstr("2.50 m below the floor"), HasSubstr("[x, z, -y]"))));
}

TEST(WallDoubts, KnowAHeadThatFacesNoScreen) {
  Written wall;
  wall.orientation = "[0, 1, 0, 0]";
  EXPECT_THAT(wall.doubts(),
              ElementsAre(AllOf(HasSubstr("away from every screen"),
                                HasSubstr("facing screen \"wall\", sweet_spot_orientation is [0, 0, 0, 1]"))));
  wall.orientation = "[0, 0.70710678, 0, 0.70710678]";
  EXPECT_THAT(wall.doubts(), ElementsAre(HasSubstr("past every screen")));
  Written aside{{2, 0.5, -1.6}, {2, 0.5, 1.6}, {2, 2.3, -1.6}, {0, 1.65, 0}, {}, {}, {}};
  EXPECT_THAT(aside.doubts(), ElementsAre(AllOf(HasSubstr("past every screen"), HasSubstr("[0, -0.7071, 0, 0.7071]"))));
  aside.orientation = "[0, -0.70710678, 0, 0.70710678]";
  EXPECT_THAT(aside.doubts(), IsEmpty());
  wall.orientation = "[0, 0.34202014, 0, 0.93969262]";  // 40 degrees to the left
  EXPECT_THAT(wall.doubts(), IsEmpty());
}

TEST(WallDoubts, KnowAQuaternionThatBeginsWithW) {
  for (const double degrees : {0.0, 30.0, -30.0}) {
    const glm::dquat turn = glm::angleAxis(glm::radians(degrees), glm::dvec3(0, 1, 0));
    Written wall;
    wall.orientation = fmt::format("[{:.8f}, {:.8f}, {:.8f}, {:.8f}]", turn.w, turn.x, turn.y, turn.z);
    const auto doubts = wall.doubts();
    ASSERT_EQ(doubts.size(), 1U) << degrees;
    EXPECT_THAT(doubts[0],
                AllOf(HasSubstr("upside down"), HasSubstr("x, y, z, w"), HasSubstr(fmt::format(", {:.4g}]", turn.w))));
  }
}

TEST(WallDoubts, KnowAMeshThatLeavesTheProjectorDark) {
  const support::ScratchFolder folder;
  folder.write("square.data", "2\n2 2\n-1 -1 0 0 1\n1 -1 1 0 1\n-1 1 0 1 1\n1 1 1 1 1\n");
  folder.write("wide.data", "2\n2 2\n-1.7778 -1 0 0 1\n1.7778 -1 1 0 1\n-1.7778 1 0 1 1\n1.7778 1 1 1 1\n");
  const auto doubts = [&](const std::string& mesh) {
    Written wall;
    wall.more =
        "[[output]]\nname = \"beamer\"\nscreen = \"wall\"\nmode = \"mono\"\nrect = [0, 0, 1920, 1080]\nwarp_mesh = \"" +
        mesh + "\"\n";
    return doubts_of(load_wall(folder.write("wall.toml", wall.text())).value());
  };
  EXPECT_THAT(doubts("square.data"), ElementsAre(AllOf(HasSubstr("output \"beamer\""), HasSubstr("44 %"),
                                                       HasSubstr("stays dark"), HasSubstr("1.78"))));
  EXPECT_THAT(doubts("wide.data"), IsEmpty());
}

TEST(WallNotes, NameEachViewerWithoutAPicture) {
  Written wall;
  wall.viewers = "[[viewer]]\nname = \"second\"\nipd = \"60 mm\"\nsweet_spot = [0.5, 1.6, 2]\n";
  EXPECT_THAT(notes_of(wall.wall().value()),
              ElementsAre("viewer \"second\": not used; every screen is drawn for the first viewer, \"guest\""));
}

// OpenCV gives homographies in pixels; 20 and 30 of them are then 20 and 30 widths of the projector.
TEST(WallDoubts, NameAHomographyInPixelsAndTheOneThatWasMeant) {
  const auto doubts = [](const std::string& numbers, const std::string& place) {
    Written wall;
    wall.more = "[[output]]\nname = \"beamer\"\nscreen = \"wall\"\nmode = \"mono\"\n" + place + "\nhomography = [" +
                numbers + "]\n";
    return wall.doubts();
  };
  const std::string desktop = "rect = [0, 0, 1600, 1200]";
  EXPECT_THAT(doubts("0.9, 0.02, 40, 0.01, 0.95, 30, -1e-5, 0, 1", desktop),
              ElementsAre(AllOf(HasSubstr("output \"beamer\": its homography puts 100 % of the picture outside"),
                                HasSubstr("pixels, write [0.9, 0.015, 0.025, 0.0133333, 0.95, 0.025, -0.016, 0, 1]"))));
  EXPECT_THAT(doubts("0.9, 0.015, 0.025, 0.0133333, 0.95, 0.025, -0.016, 0, 1", desktop), IsEmpty());
  EXPECT_THAT(doubts("0.9, 0.02, 40, 0.01, 0.95, 30, -1e-5, 0, 1", "monitor = \"DP-1\""),
              ElementsAre(AllOf(HasSubstr("100 %"), Not(HasSubstr("write")))));
  EXPECT_THAT(doubts("0.5, 0, 0.25, 0, 0.5, 0.25, 0, 0, 1", desktop), IsEmpty());
}

}  // namespace wall_doubts_test
}  // namespace afm::scene
