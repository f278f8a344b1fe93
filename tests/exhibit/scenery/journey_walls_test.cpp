// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "exhibit/scenery/journey.h"
#include "exhibit/scenery/wall_scene.h"
#include "support/paper_wall.h"

namespace afm::exhibit {
namespace journey_walls_test {

using JourneyOnWalls = test::PaperWall;

// On a screen taller than wide they ended halfway down. All atoms up to 8 nm from the contact are out of the
// ground; those up to 6.4 nm have eight corners or more.
TEST_F(JourneyOnWalls, ShowsNoEndOfTheAtomsAboveTheLowerBorder) {
  for (const char* file : {"powerwall", "phone", "desk-red-cyan", "3d-tv", "wide", "blended"}) {
    const StagePlace stage = stage_place(scene::load_wall(assets_ + "/walls/" + file + ".toml").value());
    const WallScene scene = WallScene::load(assets_, materials_, stage, test::english()).value();
    const scene::NodeIndex atoms = scene.scene().find_node("ground-mica/atoms").value();
    const scene::NodeIndex ground = scene.scene().find_node("journey-frame").value();
    bool seen = false;
    for (double orders = 8.0; orders <= kJourneyOrders + 1e-9; orders += 0.05) {
      render::FrameState state;
      scene.update({.material = 0, .centerpiece = Centerpiece::Journey, .journey_orders = orders}, state);
      const glm::dmat4 frame_from_room = glm::inverse(state.room_from_node[ground]);
      const double sunk_m = -(frame_from_room * state.room_from_node[atoms][3]).z;
      if (sunk_m > 1e-13 || state.visible[atoms] == 0) continue;
      seen = true;
      const glm::dvec3 eye(frame_from_room * glm::dvec4(stage.viewer_m, 1.0));
      for (const glm::dvec3& corner : {stage.main.lower_left, stage.main.lower_right}) {
        const glm::dvec3 below(frame_from_room * glm::dvec4(corner, 1.0));
        const glm::dvec3 place = eye + (below - eye) * (eye.z / (eye.z - below.z));
        EXPECT_LT(glm::length(place), orders < 8.94 ? 6.5e-9 : 8e-9) << file << " at " << orders;
      }
    }
    EXPECT_TRUE(seen) << file;
  }
}

}  // namespace journey_walls_test
}  // namespace afm::exhibit
