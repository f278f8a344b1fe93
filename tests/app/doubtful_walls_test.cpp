// SPDX-License-Identifier: Apache-2.0
// Wall files in other units, axes and turns, as wall, view and render meet them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/live_program.h"
#include "support/places.h"
#include "support/run_program.h"
#include "support/scratch_folder.h"
#include "support/virtual_display.h"

namespace afm::app {
namespace doubtful_walls_test {

using support::ProgramResult;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

struct Case {
  const char* file;
  bool refused;
  std::vector<const char*> said;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"millimetres.toml", true, {"3200 m x 1800 m", "as millimetres, the screen would be 3.20 m x 1.80 m"}},
      {"centimetres.toml", true, {"320 m x 180 m", "as centimetres, the screen would be 3.20 m x 1.80 m"}},
      {"head-in-millimetres.toml", true, {"2400 m in front", "sweet_spot in millimetres"}},
      {"upside-down.toml",
       false,
       {"the upper edge is below the lower edge", "upside down in the room", "lit from below"}},
      {"z-up.toml", false, {"the upper edge points along +z", "on its back", "[x, z, -y]"}},
      {"head-looks-away.toml", false, {"away from every screen", "exchanged", "[0, 0, 0, 1]"}},
      {"quaternion-w-first.toml", false, {"upside down", "x, y, z, w"}}};
  return all;
}

std::string wall(const char* file) { return support::source(std::string("tests/scene/data/walls/") + file); }

TEST(DoubtfulWalls, AreRefusedOrNotedByTheWallCommand) {
  for (const Case& one : cases()) {
    const ProgramResult result = support::run_program(support::touchafm() + " wall " + wall(one.file));
    EXPECT_EQ(result.exit_code, one.refused ? 3 : 0) << one.file;
    const std::string& text = one.refused ? result.err : result.out;
    for (const char* said : one.said) EXPECT_THAT(text, HasSubstr(said)) << one.file;
    EXPECT_THAT(text, HasSubstr(one.refused ? "touchafm: " : "note: ")) << one.file;
    EXPECT_THAT(result.out, Not(HasSubstr("the wall file is valid"))) << one.file;

    // JSON stays JSON
    const ProgramResult json = support::run_program(support::touchafm() + " wall --json " + wall(one.file));
    for (const char* said : one.said) EXPECT_THAT(json.err, HasSubstr(said)) << one.file;
    EXPECT_THAT(json.out, Not(HasSubstr("note"))) << one.file;
  }
}

// Notes on a wall of 3 m x 2.2 m and other tables, with a head in front of x = 0.
std::string notes_on(const std::string& tables) {
  const support::ScratchFolder folder;
  const std::string file =
      folder.write("wall.toml", tables + "[[viewer]]\nname = \"v\"\nipd = \"63 mm\"\nsweet_spot = [0.0, 1.65, 2.5]\n");
  const ProgramResult done = support::run_program(support::touchafm() + " wall " + file);
  EXPECT_EQ(done.exit_code, 0) << done.err;
  return done.out;
}

std::string screen(const std::string& name, const std::string& left, const std::string& right,
                   const std::string& low = "0.4", const std::string& high = "2.6") {
  const auto corner = [](const std::string& x, const std::string& y) { return " = [" + x + ", " + y + ", 0]\n"; };
  return "[[screen]]\nname = \"" + name + "\"\nlower_left" + corner(left, low) + "lower_right" + corner(right, low) +
         "upper_left" + corner(left, high);
}

std::string output(const std::string& mode, int x, const std::string& more) {
  return "[[output]]\nname = \"at " + std::to_string(x) + "\"\nscreen = \"big\"\nmode = \"" + mode + "\"\nrect = [" +
         std::to_string(x) + ", 0, 818, 600]\n" + more;
}

// Of a pair with one swapped picture both eyes see the same one: no depth at all.
TEST(DoubtfulWalls, KnowAPairThatShowsOneEyeTwice) {
  const std::string big = screen("big", "-1.5", "1.5");
  const std::string eye = "eye = \"left\"\n", other = "eye = \"right\"\n", swap = "swap = true\n";
  EXPECT_THAT(
      notes_on(big + output("dual", 0, eye) + output("dual", 818, other + swap)),
      HasSubstr("note: every output of screen \"big\" shows the left eye: set swap = true for both outputs of a "
                "pair, or for neither"));
  EXPECT_THAT(notes_on(big + output("left", 0, swap) + output("right", 818, "")), HasSubstr("shows the right eye"));
  for (const std::string& pair : {output("dual", 0, eye) + output("dual", 818, other),
                                  output("dual", 0, eye + swap) + output("dual", 818, other + swap),
                                  output("left", 0, swap) + output("right", 818, swap)}) {
    EXPECT_THAT(notes_on(big + pair), HasSubstr("the wall file is valid")) << pair;
  }
}

TEST(DoubtfulWalls, KnowAScreenWithinAnotherAndAGapInTheMiddle) {
  EXPECT_THAT(notes_on(screen("big", "-1.5", "1.5") + screen("inset", "-0.3", "0.3", "1.0", "1.4")),
              HasSubstr("note: screen \"inset\" lies within screen \"big\", and both show this part of the scene"));
  EXPECT_THAT(
      notes_on(screen("a", "-3.0", "-0.5") + screen("b", "0.5", "3.0")),
      AllOf(HasSubstr("note: screens \"a\" and \"b\" count as one, and its middle, where the tip is, lies in the "
                      "gap of 1000 mm between them"),
            HasSubstr("move them together")));
  EXPECT_THAT(notes_on(screen("a", "-3.0", "-0.02") + screen("b", "0.02", "3.0")), HasSubstr("the wall file is valid"))
      << "frames of two monitors";
  EXPECT_THAT(notes_on(screen("a", "-3.0", "-1.0") + screen("b", "-1.0", "1.0") + screen("c", "1.5", "3.0")),
              HasSubstr("the wall file is valid"));
}

TEST(DoubtfulWalls, AreRefusedOrLoggedByRender) {
  const support::ScratchFolder folder;
  for (const Case& one : cases()) {
    const ProgramResult result = support::run_program(support::touchafm() + " render --journey 4 --size 64x36 --out " +
                                                      folder.file("wall.png") + " --wall " + wall(one.file));
    EXPECT_EQ(result.exit_code, one.refused ? 3 : 0) << one.file << result.err;
    for (const char* said : one.said) EXPECT_THAT(result.err, HasSubstr(said)) << one.file;
  }
}

TEST(DoubtfulWalls, AreRefusedOrLoggedByView) {
  const support::VirtualDisplay display(320, 240);
  for (const Case& one : {cases()[0], cases()[5]}) {
    support::LiveProgram program({support::touchafm(), "view", "--size", "160x90", "--frame-rate", "12", "--eye-width",
                                  "160", "--servo", support::servo_mode(), "--wall", wall(one.file)},
                                 display.name());
    if (!one.refused) {
      ASSERT_TRUE(program.says("F1 shows the keys")) << program.said();
      program.signal(SIGTERM);
    }
    EXPECT_EQ(program.ends(), one.refused ? 3 : 0) << program.said();
    for (const char* said : one.said) EXPECT_THAT(program.said(), HasSubstr(said)) << one.file;
  }
}

TEST(DoubtfulWalls, OfParaViewTakeStereoAndViewers) {
  const ProgramResult pair = support::run_program(support::touchafm() + " wall " + wall("stereo-types.pvx"));
  EXPECT_EQ(pair.exit_code, 0) << pair.err;
  EXPECT_THAT(pair.out, AllOf(HasSubstr("output pl: screen pl, dual, left eye, 1920 x 1080 pixels at 0, 0"),
                              HasSubstr("output pr: screen pl, dual, right eye, 1920 x 1080 pixels at 1920, 0"),
                              HasSubstr("64.0 mm between the eyes")));
  const ProgramResult viewers = support::run_program(support::touchafm() + " wall " + wall("viewers.pvx"));
  EXPECT_THAT(viewers.out, HasSubstr("58.0 mm between the eyes"));
}

// The height of a capital letter, as a person measures it on the wall, not of the em square.
TEST(WallCommand, SaysHowHighACapitalIs) {
  const ProgramResult result =
      support::run_program(support::touchafm() + " wall " + support::source("assets/walls/powerwall.toml"));
  EXPECT_THAT(result.out, HasSubstr("the smallest capital letters are 18.0 mm high, 25 arc minutes"));
}

// Tiles of one plane are one screen, which has no name in the file.
TEST(WallCommand, SaysThatTheSceneIsOnAllTiles) {
  const auto composition = [](const char* name) {
    return support::run_program(support::touchafm() + " wall " + name).out;
  };
  EXPECT_THAT(composition("tiled-2x2"), HasSubstr("composition: scene on all screens, panels"));
  EXPECT_THAT(composition("cave"), HasSubstr("composition: scene on screen front, panels"));
}

// Of an installed program nobody knows the folder of the presets.
TEST(IncludedWalls, AreGivenByNameUnlessThereIsSuchAFile) {
  const support::ScratchFolder folder;
  const auto wall_in_folder = [&](const std::string& name) {
    return support::run_program("cd " + folder.path() + " && " + support::touchafm() + " wall " + name);
  };
  EXPECT_THAT(wall_in_folder("cave").out, HasSubstr("screen front"));
  EXPECT_THAT(wall_in_folder("cave.toml").out, HasSubstr("screen front"));
  EXPECT_EQ(wall_in_folder("./cave.toml").exit_code, 3);
  EXPECT_THAT(wall_in_folder("wall.toml").err, HasSubstr("wall file wall.toml: cannot be read: there is no such file"));
  const ProgramResult misspelt = wall_in_folder("cove");
  EXPECT_EQ(misspelt.exit_code, 2);
  EXPECT_THAT(misspelt.err,
              HasSubstr("error: file: \"cove\" is neither a file nor included; choose 3d-tv, blended, cave,"));
  const ProgramResult with_ending = wall_in_folder("cove.toml");
  EXPECT_EQ(with_ending.exit_code, 2);
  EXPECT_THAT(with_ending.err, HasSubstr("\"cove.toml\" is neither a file nor included; choose 3d-tv, blended, cave,"));
  EXPECT_EQ(wall_in_folder("./cove.toml").exit_code, 3);
  const ProgramResult machines =
      support::run_program(support::touchafm() + " doctor --cluster cave --interface 127.0.0.1");
  EXPECT_THAT(machines.err, HasSubstr("the wall file names no other machine"));
  folder.write("cave", "[[screen]]\n");
  EXPECT_THAT(wall_in_folder("cave").err, HasSubstr("wall file cave: line 1: screen.name"));
  const ProgramResult lesson = support::run_program("cd " + folder.path() + " && " + support::touchafm() +
                                                    " lesson first-touch --participant sim:1 --out class");
  EXPECT_EQ(lesson.exit_code, 0) << lesson.err;
}

}  // namespace doubtful_walls_test
}  // namespace afm::app
