// SPDX-License-Identifier: Apache-2.0
// Soft samples and ink on the wall: their panels, and the reliefs of their marks.
#include "exhibit/panels/scratch_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "exhibit/models/marks_relief.h"
#include "exhibit/panels/ink_panel.h"
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

class InkPanel : public ::testing::Test {
 protected:
  render::DataRow row(const scene::TipPush& push, Phrase name) const {
    const render::DataPanel panel = ink_panel({.set = &set_, .push = push}, test::english());
    const auto found = std::find_if(panel.rows.begin(), panel.rows.end(), [&](const render::DataRow& candidate) {
      return candidate.name == test::english()[name];
    });
    return found == panel.rows.end() ? render::DataRow{} : *found;
  }

  scene::ParticleSet set_ = test::particle_set("write-ink");
  scene::TipPush push_{.lift_n = -12e-9,
                       .softened_upwards = 2.0,
                       .state = physics::PushState::Slides,
                       .met = 1,
                       .strokes = 3,
                       .ink = {.covered_m2 = 2.16e-14, .flowed_s = 1.0, .speed_m_per_s = 100e-9}};
};

// N67
TEST_F(InkPanel, ShowsForceLineDotAndArea) {
  EXPECT_EQ(row(push_, Phrase::PushStateName).value, "writes");
  EXPECT_EQ(row(push_, Phrase::InkForce).value, "-12 nN");
  EXPECT_EQ(row(push_, Phrase::InkForce).source, "the liquid tears at 18.3 nN");
  EXPECT_EQ(row(push_, Phrase::InkLine), (render::DataRow{"Line, by formula", "216 nm", "wide at 0.1 um/s"}));
  EXPECT_EQ(row(push_, Phrase::InkDot).value, "166 nm");
  EXPECT_EQ(row(push_, Phrase::InkCovered).value, "21600 nm\u00b2");
  EXPECT_EQ(row(push_, Phrase::LeverSoftened).value, "2 times softer");
  EXPECT_EQ(ink_panel({.set = &set_, .push = push_}, test::english()).subtitle, "Strokes to take back: 3");
}

TEST_F(InkPanel, OfATipThatRestsOrIsFree) {
  push_.ink.speed_m_per_s = 0.0;
  push_.ink.covered_m2 = 0.3e-12;
  EXPECT_EQ(row(push_, Phrase::InkLine).value, "-");
  EXPECT_EQ(row(push_, Phrase::InkLine).source, "the tip rests");
  EXPECT_EQ(row(push_, Phrase::InkCovered).value, "0.30 \u00b5m\u00b2");
  EXPECT_EQ(row({}, Phrase::PushStateName).value, "free");
  EXPECT_EQ(row({}, Phrase::InkLine).name, "");
  EXPECT_EQ(row({}, Phrase::InkTension).value, "72.8 mN/m");
}

TEST(MarksRelief, LiesAsTheServoHasTheMarks) {
  std::vector<scene::MarkTile> tiles(scene::kMarkTiles);
  const MarksScale scale = marks_scale(test::particle_set("scratch-pmma"));
  EXPECT_NEAR(scale.side_m, 640e-9, 1e-15);
  const HeightRelief level = marks_relief(tiles, scale);
  EXPECT_NEAR(level.range_m, 5e-9, 1e-18);
  // a dent in the tile with the largest x and the least y
  tiles[15].pressed_m.fill(-9e-9);
  tiles[15].back_m.fill(1e-9);
  const HeightRelief dented = marks_relief(tiles, scale);
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

TEST(MarksRelief, ShowsALayerOfInkInTheBrightestColour) {
  const scene::ParticleSet set = test::particle_set("write-ink");
  std::vector<scene::MarkTile> tiles(scene::kMarkTiles);
  EXPECT_NEAR(marks_relief(tiles, marks_scale(set)).range_m, 2e-9, 1e-18) << "the colours of a bare sample";
  tiles[0].pressed_m.fill(2e-9);
  const HeightRelief inked = marks_relief(tiles, marks_scale(set));
  EXPECT_NEAR(inked.side_m, 1.658e-6, 0.001e-6);
  EXPECT_NEAR(inked.range_m, 2e-9, 1e-18);
}

}  // namespace scratch_panel_test
}  // namespace afm::exhibit
