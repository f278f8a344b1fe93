// SPDX-License-Identifier: Apache-2.0
// A soft sample on the wall: its panel, and the relief of its marks.
#include "exhibit/panels/scratch_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "exhibit/models/marks_relief.h"
#include "support/particles/particle_sets.h"
#include "support/phrases.h"

namespace afm::exhibit {
namespace scratch_panel_test {

using physics::PushState;
using testing::HasSubstr;

class ScratchPanel : public ::testing::Test {
 protected:
  render::DataRow row(const scene::TipPush& push, Phrase name) const {
    const render::DataPanel panel = scratch_panel({.set = &set_, .push = push}, test::english());
    const auto found = std::find_if(panel.rows.begin(), panel.rows.end(), [&](const render::DataRow& candidate) {
      return candidate.name == test::english()[name];
    });
    return found == panel.rows.end() ? render::DataRow{} : *found;
  }

  scene::ParticleSet set_ = test::particle_set("scratch-pmma");
  scene::TipPush push_{.apex_m = {0.0, 0.0, -6.3e-9},
                       .lateral_n = {-30e-9, 40e-9},
                       .lift_n = 100e-9,
                       .softened_sideways = 4.2,
                       .state = PushState::Slides,
                       .met = 1,
                       .strokes = 3,
                       .rise_m = 0,
                       .fastest_hand_m_per_s = 0.15};
};

TEST_F(ScratchPanel, ShowsDepthLoadAndGroove) {
  EXPECT_EQ(row(push_, Phrase::PushStateName).value, "marks the sample");
  EXPECT_EQ(row(push_, Phrase::SoftLoad).value, "100 nN");
  EXPECT_EQ(row(push_, Phrase::SoftDepth).value, "6.3 nm");
  EXPECT_EQ(row(push_, Phrase::PushLateral), (render::DataRow{"Lateral force", "50 nN", "0.50 of the load"}));
  // N60
  EXPECT_EQ(row(push_, Phrase::SoftGroove).value, "29.1 nm");
  EXPECT_THAT(row(push_, Phrase::SoftGroove).source, HasSubstr("6.3 nm deep"));
  EXPECT_EQ(row(push_, Phrase::LeverSoftened).value, "4.2 times softer");
  EXPECT_EQ(scratch_panel({.set = &set_, .push = push_}, test::english()).subtitle, "Scratches to take back: 3");
  EXPECT_EQ(row({}, Phrase::PushStateName).value, "free");
  EXPECT_EQ(row({}, Phrase::SoftGroove).value, "");
}

TEST_F(ScratchPanel, LeavesTheLawOutOfThePlotOfForce) {
  render::ForcePanel plot;
  plot.stage = "B -> A";
  plot.markers.push_back({.value = 2.4, .label = "Z_jtc 2.40 nm"});
  plot.curves.resize(2);
  plot.curves[0].faded = true;
  plot.curves[1].label = "Mica";
  plot.curves[1].approach.push_back({.place_nm = -30.0, .force_nn = 12.0});
  leave_law_out({.set = &set_, .push = push_}, test::english(), plot);
  EXPECT_EQ(plot.stage, "");
  EXPECT_TRUE(plot.markers.empty());
  ASSERT_EQ(plot.curves.size(), 1U);
  EXPECT_EQ(plot.curves.front().label, set_.title);
  EXPECT_LT(plot.place_min_nm, -30.0);
  EXPECT_GT(plot.force_max_nn, 12.0);
  EXPECT_LT(plot.force_min_nn, 0.0);
}

TEST_F(ScratchPanel, SaysWhenTheHandIsTooFast) {
  EXPECT_THAT(row(push_, Phrase::SoftSpeed).source, HasSubstr("slow enough"));
  push_.rise_m = 20e-9;
  EXPECT_EQ(row(push_, Phrase::SoftSpeed).source, "too fast: the lever is raised by 20 nm");
  EXPECT_EQ(row({}, Phrase::SoftSpeed).value, "");
}

TEST(MarksRelief, LiesAsTheServoHasTheMarks) {
  std::vector<scene::MarkTile> tiles(scene::kMarkTiles);
  const double side_m = marks_side_m(20e-9);
  EXPECT_NEAR(side_m, 640e-9, 1e-15);
  const HeightRelief level = marks_relief(tiles, 20e-9);
  EXPECT_NEAR(level.range_m, 5e-9, 1e-18);
  // a dent in the tile with the largest x and the least y
  tiles[15].pressed_m.fill(-9e-9);
  tiles[15].back_m.fill(1e-9);
  const HeightRelief dented = marks_relief(tiles, 20e-9);
  EXPECT_NEAR(dented.range_m, 16e-9, 1e-18) << "the colours reach the deepest mark";
  const auto height_m = [&](const HeightRelief& relief, std::size_t column, std::size_t row) {
    const auto share = static_cast<double>(relief.vertices[row * kReliefSide + column].position.z);
    return relief.floor_m + (relief.lid_m - relief.floor_m) * share;
  };
  for (const auto& [column, row] : {std::pair<std::size_t, std::size_t>{127, 127}, {121, 121}}) {
    EXPECT_NEAR(height_m(dented, column, row), -8e-9, 1e-13);
    EXPECT_GT(dented.vertices[row * kReliefSide + column].position.x, 0.0F);
    EXPECT_LT(dented.vertices[row * kReliefSide + column].position.y, 0.0F);
  }
  EXPECT_NEAR(height_m(dented, 0, 0), 0.0, 1e-13);
  EXPECT_NEAR(height_m(dented, 127, 0), 0.0, 1e-13);
}

}  // namespace scratch_panel_test
}  // namespace afm::exhibit
