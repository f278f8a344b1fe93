// SPDX-License-Identifier: Apache-2.0
#include "exhibit/cluster/living_screens.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <optional>
#include <string>

namespace afm::exhibit {
namespace living_screens_test {

// A wall of three screens side by side, 2 m wide each, the middle one driven by the machine with the hand.
scene::Wall wall_of_three() {
  scene::Wall wall;
  for (int i = 0; i < 3; ++i) {
    const double left = 2.0 * i - 3.0;
    wall.screens.push_back({.name = std::to_string(i),
                            .lower_left = {left, 0.5, 0.0},
                            .lower_right = {left + 2.0, 0.5, 0.0},
                            .upper_left = {left, 2.5, 0.0}});
  }
  wall.nodes = {{"left", "10.0.0.2"}, {"right", "10.0.0.3"}};
  wall.outputs.resize(3);
  wall.outputs[0].screen = 0;
  wall.outputs[0].node = 0;
  wall.outputs[1].screen = 1;
  wall.outputs[2].screen = 2;
  wall.outputs[2].node = 1;
  return wall;
}

const render::PanelPlacement kBanner{
    .lower_left_m = {-2.9, 2.2, 0.0}, .right_m = {5.8, 0.0, 0.0}, .up_m = {0.0, 0.2, 0.0}};

struct Ends {
  double left_m, right_m;
};
Ends ends_of(const render::PanelPlacement& placement) {
  return {placement.lower_left_m.x, placement.lower_left_m.x + placement.right_m.x};
}

TEST(BannerOfACluster, StaysWhereItIsWhileEveryMachineDraws) {
  EXPECT_EQ(on_living_screens(kBanner, wall_of_three(), {}), kBanner);
}

// Each machine has opened its own outputs only; all must agree on the banner's place.
TEST(BannerOfACluster, IsInTheSamePlaceOnEveryMachine) {
  const AbsentMachines right_dead{.nodes = 0b10, .master = false};
  const render::PanelPlacement whole = on_living_screens(kBanner, wall_of_three(), right_dead);
  for (const auto machine : {std::optional<std::size_t>(), std::optional<std::size_t>(0)}) {
    scene::Wall own = wall_of_three();
    scene::keep_outputs_of(machine, own);
    ASSERT_EQ(own.outputs.size(), 1U);
    EXPECT_EQ(on_living_screens(kBanner, own, right_dead), whole);
  }
}

TEST(BannerOfACluster, LeavesTheScreenThatIsMissing) {
  const scene::Wall wall = wall_of_three();
  const Ends right = ends_of(on_living_screens(kBanner, wall, {.nodes = 0b10, .master = false}));
  EXPECT_NEAR(right.left_m, -2.95, 0.05);
  EXPECT_LT(right.right_m, 1.0) << "state and warning stand at its right end";
  EXPECT_GT(right.right_m, 0.9);
  const Ends left = ends_of(on_living_screens(kBanner, wall, {.nodes = 0b01, .master = false}));
  EXPECT_GT(left.left_m, -1.0);
  EXPECT_NEAR(left.right_m, 2.95, 0.05);
  const Ends middle = ends_of(on_living_screens(kBanner, wall, {.nodes = 0b11, .master = false}));
  EXPECT_GT(middle.left_m, -1.0);
  EXPECT_LT(middle.right_m, 1.0);
}

// The panels are in the middle of a wide wall, which leaves room on each side for a banner of the same size.
TEST(BannerOfACluster, KeepsItsSizeWhereTheLivingScreensHaveTheRoom) {
  render::PanelPlacement short_banner = kBanner;
  short_banner.lower_left_m.x = -1.5;
  short_banner.right_m.x = 3.0;
  const render::PanelPlacement moved =
      on_living_screens(short_banner, wall_of_three(), {.nodes = 0b10, .master = false});
  EXPECT_NEAR(moved.right_m.x, 3.0, 1e-12);
  EXPECT_NEAR(ends_of(moved).right_m, 0.95, 0.05);
}

// The nodes keep the last picture of a master that is gone; no banner extends across its screen.
TEST(BannerOfACluster, LeavesTheScreenOfTheMasterThatIsGone) {
  const Ends ends = ends_of(on_living_screens(kBanner, wall_of_three(), {.nodes = 0, .master = true}));
  EXPECT_TRUE(ends.right_m < -1.0 || ends.left_m > 1.0) << ends.left_m << " to " << ends.right_m;
}

TEST(BannerOfACluster, GoesToAnotherPlaneIfItsOwnIsDark) {
  scene::Wall cave = wall_of_three();
  // the right screen turned towards the viewer; the other two are dark
  cave.screens[2].lower_left = {1.0, 0.5, 0.0};
  cave.screens[2].lower_right = {1.0, 0.5, 2.0};
  cave.screens[2].upper_left = {1.0, 2.5, 0.0};
  const render::PanelPlacement moved = on_living_screens(kBanner, cave, {.nodes = 0b01, .master = true});
  for (const glm::dvec3& corner : {moved.lower_left_m, moved.lower_left_m + moved.right_m + moved.up_m}) {
    EXPECT_NEAR(corner.x, 1.0, 1e-12);
    EXPECT_GT(corner.y, 0.5);
    EXPECT_LT(corner.y, 2.5);
    EXPECT_GT(corner.z, 0.0);
    EXPECT_LT(corner.z, 2.0);
  }
  EXPECT_GT(glm::length(moved.right_m), 1.5);
}

TEST(BannerOfACluster, LeavesTheUpperRowOfTilesThatIsDark) {
  scene::Wall tiles = wall_of_three();
  for (scene::Screen& screen : tiles.screens) {
    screen.lower_left.y = screen.lower_right.y = 1.5;
  }
  tiles.screens.push_back({"below", {-3.0, 0.5, 0.0}, {3.0, 0.5, 0.0}, {-3.0, 1.5, 0.0}});
  tiles.nodes.push_back({"below", "10.0.0.4"});
  tiles.outputs.push_back(tiles.outputs.back());
  tiles.outputs.back().screen = 3;
  tiles.outputs.back().node = 2;
  const render::PanelPlacement moved = on_living_screens(kBanner, tiles, {.nodes = 0b011, .master = true});
  EXPECT_LT(moved.lower_left_m.y + moved.up_m.y, 1.5);
}

// Two projectors on one screen, of two machines: its picture is dark for one eye at most.
TEST(BannerOfACluster, StaysOnAScreenThatAnotherMachineDrawsToo) {
  scene::Wall wall = wall_of_three();
  for (scene::Output& output : wall.outputs) output.screen = 1;
  wall.screens[1].lower_left.x = wall.screens[1].upper_left.x = -3.0;
  wall.screens[1].lower_right.x = 3.0;
  EXPECT_EQ(on_living_screens(kBanner, wall, {.nodes = 0b10, .master = false}), kBanner);
}

TEST(BannerOfACluster, StaysHiddenAndStaysIfNobodyDraws) {
  const scene::Wall wall = wall_of_three();
  EXPECT_EQ(on_living_screens(render::kNoPlacement, wall, {.nodes = 0b10, .master = false}), render::kNoPlacement);
  EXPECT_EQ(on_living_screens(kBanner, wall, {.nodes = 0b11, .master = true}), kBanner);
}

}  // namespace living_screens_test
}  // namespace afm::exhibit
