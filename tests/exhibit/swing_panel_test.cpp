// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/swing_panel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "support/phrases.h"
#include "support/tapped_sample.h"

namespace afm::exhibit {
namespace swing_panel_test {

constexpr double kDegree = std::numbers::pi / 180.0;

const curves::SampleModel& sample() {
  static const curves::SampleModel model = test::tapped_sample();
  return model;
}

render::ForcePanel panel_at(double z_nm, const scene::Swing& swing = {}) {
  scene::TipState tip;
  tip.tip.z_m = z_nm * 1e-9;
  tip.swing = swing;
  return swing_panel(sample(), tip, test::english());
}

// The end of a hand; none: there is no such hand.
const render::PlotPoint* end_of(const render::ForcePanel& panel, const std::string& label) {
  for (const render::PlotCurve& curve : panel.curves) {
    if (curve.label == label) return &curve.retract.back();
  }
  return nullptr;
}

// Row T42 of the cases: amplitudes and phases of both states.
TEST(SwingPanel, ShowsBothStatesWhereBothExist) {
  const render::ForcePanel panel = panel_at(17.4149);
  EXPECT_EQ(panel.stage, "both states exist at this height");
  const render::PlotPoint* const attractive = end_of(panel, "attractive");
  const render::PlotPoint* const repulsive = end_of(panel, "repulsive");
  ASSERT_TRUE(attractive != nullptr && repulsive != nullptr);
  EXPECT_NEAR(std::hypot(attractive->place_nm, attractive->force_nn), 17.4935, 0.03);
  EXPECT_NEAR(std::atan2(attractive->force_nn, attractive->place_nm) / kDegree, 118.99, 0.3);
  EXPECT_NEAR(std::hypot(repulsive->place_nm, repulsive->force_nn), 18.8572, 0.03);
  EXPECT_NEAR(std::atan2(repulsive->force_nn, repulsive->place_nm) / kDegree, 70.54, 0.3);
}

TEST(SwingPanel, ShowsOneStateBeyondTheFolds) {
  EXPECT_EQ(panel_at(25.0).stage, "one state at this height");
  EXPECT_EQ(end_of(panel_at(25.0), "repulsive"), nullptr);
  EXPECT_EQ(end_of(panel_at(12.0), "attractive"), nullptr);
  EXPECT_NE(end_of(panel_at(12.0), "repulsive"), nullptr);
}

TEST(SwingPanel, PointsAtTheSwingOfNow) {
  EXPECT_FALSE(panel_at(25.0).cursor.has_value());
  const render::ForcePanel panel = panel_at(17.0, {.amplitude_m = 16e-9, .phase_rad = 120.0 * kDegree});
  ASSERT_TRUE(panel.cursor.has_value());
  EXPECT_NEAR(panel.cursor->place_nm, -8.0, 1e-9);
  EXPECT_NEAR(panel.cursor->force_nn, 16.0 * std::sin(120.0 * kDegree), 1e-9);
  EXPECT_LT(panel.place_min_nm, -10.0);
  EXPECT_GT(panel.force_max_nn, 20.0);
}

TEST(SwingPanel, ShowsNoStatesThatLoseEnergy) {
  curves::SampleModel viscous = sample();
  viscous.parameters.viscosity_pa_s = 1.0;
  scene::TipState tip;
  tip.tip.z_m = 17.4e-9;
  EXPECT_EQ(end_of(swing_panel(viscous, tip, test::english()), "attractive"), nullptr);
}

}  // namespace swing_panel_test
}  // namespace afm::exhibit
