// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/parameter_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "curves/sample_model.h"
#include "render/control_layout.h"
#include "render/presenter.h"
#include "scene/samples/material_library.h"
#include "support/phrases.h"
#include "support/places.h"

namespace afm::exhibit {
namespace parameter_panel_test {

using ::testing::Contains;
using ::testing::HasSubstr;
using Target = render::ControlTarget;

const glm::dvec2 kSize(754.0, 920.0);

curves::LiveParameters mica() {
  return curves::LiveParameters(
      curves::make_sample_model(
          curves::ContactSetup{
              *scene::load_materials(support::source("assets/materials.toml")).value().find("mica"), {}, {}})
          .value());
}

TEST(ParameterPanel, ShowsWhatFollowsFromTheParameters) {
  const auto panel = parameter_panel(mica(), "Mica", ChangeState::AsLoaded, test::english());
  EXPECT_THAT(panel.notes, Contains(HasSubstr("Snap-in 240 pN at 2.4 nm")));
  EXPECT_THAT(panel.notes, Contains(HasSubstr("Pull-off 1.4 nN at 14 nm")));
  EXPECT_THAT(panel.notes, Contains(HasSubstr("Tabor")));
  EXPECT_EQ(panel.rows[1].value, "100 mN/m");
  EXPECT_FALSE(panel.rows[1].changed);
}

TEST(ParameterPanel, NamesTheGraphicsDevice) {
  const auto with = parameter_panel(mica(), "Mica", ChangeState::AsLoaded, test::english(), "llvmpipe");
  EXPECT_EQ(with.notes.back(), "Drawn by llvmpipe");
  const auto without = parameter_panel(mica(), "Mica", ChangeState::AsLoaded, test::english());
  EXPECT_THAT(without.notes, testing::Not(Contains(HasSubstr("Drawn by"))));
}

TEST(ParameterPanel, EveryTargetIsHitInItsMiddleAndNoTwoOverlap) {
  const auto panel = parameter_panel(mica(), "Mica", ChangeState::AsLoaded, test::english(), "llvmpipe");
  std::vector<Target> targets;
  for (std::size_t i = 0; i < panel.rows.size(); ++i) {
    targets.push_back({Target::Kind::Less, i});
    targets.push_back({Target::Kind::More, i});
  }
  for (std::size_t i = 0; i < panel.buttons.size(); ++i) targets.push_back({Target::Kind::Button, i});
  for (const Target& target : targets) {
    const auto box = render::control_box(panel, kSize, target);
    EXPECT_GE(box.from_mm.x, 0.0);
    EXPECT_LE(box.to_mm.x, kSize.x);
    EXPECT_LE(box.to_mm.y, kSize.y);
    EXPECT_GT(box.to_mm.y - box.from_mm.y, 70.0) << "too small to be hit from ten metres";
    EXPECT_EQ(render::control_at(panel, kSize, 0.5 * (box.from_mm + box.to_mm)), target);
    EXPECT_EQ(render::control_at(panel, kSize, box.from_mm + 1.0), target);
    EXPECT_EQ(render::control_at(panel, kSize, box.to_mm - 1.0), target);
  }
  EXPECT_FALSE(render::control_at(panel, kSize, {20.0, 20.0}));
}

TEST(ParameterPanel, ThePredictionIsBehindTheFeltCurvesWithAxesThatHoldIt) {
  render::ForcePanel panel;
  panel.curves.resize(1);
  add_prediction(mica(), test::english(), panel);
  ASSERT_EQ(panel.curves.size(), 2U);
  EXPECT_EQ(panel.curves.front().label, "predicted");
  EXPECT_TRUE(panel.curves.front().faded);
  EXPECT_GT(panel.place_max_nm, 14.0);
  EXPECT_LT(panel.force_min_nn, -1.4);
  EXPECT_EQ(panel.markers.size(), 4U);
}

TEST(ParameterPanel, TheForecastLeavesAxesAndMarkers) {
  render::ForcePanel panel;
  panel.curves.resize(1);
  panel.markers.resize(1);
  const render::ForcePanel before = panel;
  add_forecast(mica(), test::english(), panel);
  ASSERT_EQ(panel.curves.size(), 2U);
  EXPECT_TRUE(panel.curves.front().faded);
  EXPECT_FALSE(panel.curves.front().retract.empty());
  panel.curves.erase(panel.curves.begin());
  EXPECT_EQ(panel, before);
}

TEST(PicturePlace, KeepsProportionsBetweenBarsAndScalesNothingThatFits) {
  const auto wide = render::picture_place({1000, 300}, {400, 300});
  EXPECT_EQ(wide.offset_px, glm::uvec2(300, 0));
  EXPECT_EQ(wide.size_px, glm::uvec2(400, 300));
  const auto tall = render::picture_place({200, 900}, {400, 300});
  EXPECT_EQ(tall.size_px, glm::uvec2(200, 150));
  EXPECT_EQ(tall.offset_px, glm::uvec2(0, 375));
  const auto nearly = render::picture_place({401, 301}, {400, 300});
  EXPECT_EQ(nearly.size_px, glm::uvec2(400, 300)) << "a pixel of border is better than a blurred picture";
  EXPECT_GE(render::picture_place({1, 1}, {4000, 30}).size_px.y, 1U);
}

}  // namespace parameter_panel_test
}  // namespace afm::exhibit
