// SPDX-License-Identifier: Apache-2.0
// Invariant: the scene is on the screen that the viewer faces; panels fit on upright, wide, flat and cornered walls
#include "exhibit/scenery/stage_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <string>

#include "exhibit/frame/exhibit_setup.h"
#include "exhibit/scenery/wall_layout.h"
#include "support/places.h"

namespace afm::exhibit {
namespace stage_place_test {

scene::Wall preset_wall(const std::string& name) {
  return scene::load_wall(support::source("assets/walls/") + name + ".toml").value();
}

std::string name_or_none(const std::optional<scene::Screen>& screen) { return screen ? screen->name : "none"; }

TEST(StagePlaceOfAWall, IsTheScreenThatTheViewerFacesWhateverTheOrderOfTheFile) {
  scene::Wall cave = preset_wall("cave");
  for (std::size_t turn = 0; turn < cave.screens.size(); ++turn) {
    std::rotate(cave.screens.begin(), cave.screens.begin() + 1, cave.screens.end());
    const StagePlace place = stage_place(cave);
    EXPECT_EQ(place.main.name, "front") << turn;
    EXPECT_EQ(name_or_none(place.left), "left") << turn;
    EXPECT_EQ(name_or_none(place.right), "right") << turn;
  }
}

TEST(StagePlaceOfAWall, TurnsWithTheHead) {
  scene::Wall cave = preset_wall("cave");
  scene::HeadPose& head = cave.viewers.front().sweet_spot;
  head.room_from_head = glm::angleAxis(glm::radians(-90.0), glm::dvec3(0.0, 1.0, 0.0));  // to the right
  const StagePlace place = stage_place(cave);
  EXPECT_EQ(place.main.name, "right");
  EXPECT_EQ(name_or_none(place.left), "front");
  EXPECT_EQ(name_or_none(place.right), "none") << "the CAVE is open there";
  EXPECT_EQ(wall_shape(place).arrangement, Arrangement::Beside);
}

TEST(StagePlaceOfAWall, JoinsTilesAndTakesNoScreenForItsOwnSide) {
  const StagePlace tiles = stage_place(preset_wall("tiled-2x2"));
  EXPECT_NEAR(tiles.main.width_m(), 3.048, 1e-9);
  EXPECT_NEAR(tiles.main.height_m(), 2.286, 1e-9);
  const StagePlace blended = stage_place(preset_wall("blended"));
  EXPECT_NEAR(blended.main.width_m(), 6.0, 1e-9);
  EXPECT_NEAR(blended.main.height_m(), 2.0, 1e-9);
  for (const char* flat : {"tiled-2x2", "blended", "powerwall", "phone", "floor", "desk-red-cyan"}) {
    const StagePlace place = stage_place(preset_wall(flat));
    EXPECT_FALSE(place.left || place.right) << flat;
  }
}

TEST(StagePlaceOfAWall, OfTwoThatAreFacedAlikeIsTheLarger) {
  scene::Wall wedge = preset_wall("powerwall");
  // two walls that meet before the viewer at a right angle, the second one wider
  wedge.screens = {{"short", {-2.0, 0.4, 2.0}, {0.0, 0.4, 0.0}, {-2.0, 2.6, 2.0}},
                   {"long", {0.0, 0.4, 0.0}, {2.5, 0.4, 2.5}, {0.0, 2.6, 0.0}}};
  EXPECT_EQ(stage_place(wedge).main.name, "long");
}

TEST(WallShape, PutsThePanelsWhereThereIsRoomForThem) {
  const auto arrangement = [](const char* preset) { return wall_shape(stage_place(preset_wall(preset))).arrangement; };
  EXPECT_EQ(arrangement("powerwall"), Arrangement::Beside);
  EXPECT_EQ(arrangement("wide"), Arrangement::Beside);
  EXPECT_EQ(arrangement("floor"), Arrangement::Beside);
  EXPECT_EQ(arrangement("phone"), Arrangement::Below);
  EXPECT_EQ(arrangement("cave"), Arrangement::SideScreens);
}

TEST(StageWithoutAWallFile, FillsTheProportionsOfTheWindow) {
  ExhibitFiles files;
  files.assets_dir = support::source("assets");
  for (const double aspect : {16.0 / 9.0, 4.0 / 3.0, 9.0 / 16.0}) {
    files.aspect = aspect;
    const auto stage = load_exhibit(files);
    ASSERT_TRUE(stage) << stage.error().message;
    EXPECT_NEAR(stage->screen.width_m() / stage->screen.height_m(), aspect, 0.01);
    EXPECT_NEAR(stage->screen.height_m(), 2.286, 1e-9);
    EXPECT_NEAR(stage->screen.center().x, 0.0, 1e-9);
  }
  files.aspect = 16.0 / 9.0;
  files.wall = files.assets_dir + "/walls/powerwall.toml";
  EXPECT_NEAR(load_exhibit(files)->screen.width_m(), 3.048, 1e-9) << "a wall file is believed";
}

}  // namespace stage_place_test
}  // namespace afm::exhibit
