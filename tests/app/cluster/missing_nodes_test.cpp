// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "app/cluster/cluster_master.h"
#include "render/frame.h"
#include "support/phrases.h"

namespace afm::app {
namespace missing_nodes_test {

TEST(MissingNodes, AreNamedOnTheWallInItsOrder) {
  scene::Wall wall;
  wall.nodes = {{"left", "10.0.0.2"}, {"front", "10.0.0.3"}, {"right", "10.0.0.4"}};
  EXPECT_EQ(missing_text(0, wall, test::english()), "");
  EXPECT_EQ(missing_text(0b010, wall, test::english()), "screen missing: front");
  EXPECT_EQ(missing_text(0b101, wall, test::english()), "screen missing: left, right");

  render::Banner banner;
  add_warning("", banner);
  EXPECT_EQ(banner.warning, "");
  add_warning(missing_text(0b001, wall, test::english()), banner);
  add_warning("no hand", banner);
  EXPECT_EQ(banner.warning, "screen missing: left, no hand");
}

}  // namespace missing_nodes_test
}  // namespace afm::app
