// SPDX-License-Identifier: Apache-2.0
#include "exhibit/panels/swing_panel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "exhibit/panels/data_panel.h"
#include "support/phrases.h"
#include "support/samples/tapped_sample.h"

namespace afm::exhibit {
namespace swing_panel_test {

constexpr double kDegree = std::numbers::pi / 180.0;

const curves::SampleModel& sample() {
  static const curves::SampleModel model = test::tapped_sample();
  return model;
}

// The sample of the tests with another option of the lever or the contact.
curves::SampleModel sample_with(const std::string& drive, const std::string& viscosity) {
  curves::TappedHand hand = test::tapped_hand();
  hand.choice.numbers.drive = drive;
  hand.choice.numbers.viscosity = viscosity;
  return curves::make_sample_model(curves::tapped_setup(sample().setup.material, hand).value()).value();
}

render::ForcePanel panel_of(const curves::SampleModel& model, double z_nm, const scene::Swing& swing = {}) {
  scene::TipState tip;
  tip.tip.z_m = z_nm * 1e-9;
  tip.swing = swing;
  return SwingDial().panel(model, tip, test::english());
}

render::ForcePanel panel_at(double z_nm, const scene::Swing& swing = {}) { return panel_of(sample(), z_nm, swing); }

// The end of a hand; none: there is no such hand.
const render::PlotPoint* end_of(const render::ForcePanel& panel, const std::string& label) {
  for (const render::PlotCurve& curve : panel.curves) {
    if (curve.label == label) return &curve.retract.back();
  }
  return nullptr;
}

void expect_hand(const render::ForcePanel& panel, const std::string& label, double a_nm, double phase_deg) {
  const render::PlotPoint* const end = end_of(panel, label);
  ASSERT_NE(end, nullptr) << label;
  EXPECT_NEAR(std::hypot(end->place_nm, end->force_nn), a_nm, 0.03) << label;
  EXPECT_NEAR(std::atan2(end->force_nn, end->place_nm) / kDegree, phase_deg, 0.3) << label;
}

// Row T42 of the cases: amplitudes and phases of both states.
TEST(SwingPanel, ShowsBothStatesAndTheEdgeWhereBothExist) {
  const render::ForcePanel panel = panel_at(17.4149);
  EXPECT_EQ(panel.stage, "both states exist at this height");
  expect_hand(panel, "attractive", 17.4935, 118.99);
  expect_hand(panel, "repulsive", 18.8572, 70.54);
  EXPECT_NE(end_of(panel, "edge"), nullptr);
}

TEST(SwingPanel, ShowsOneStateBeyondTheFolds) {
  EXPECT_EQ(panel_at(25.0).stage, "one state at this height");
  EXPECT_EQ(end_of(panel_at(25.0), "repulsive"), nullptr);
  EXPECT_NE(end_of(panel_at(25.0), "free"), nullptr);
  EXPECT_EQ(end_of(panel_at(12.0), "attractive"), nullptr);
  EXPECT_NE(end_of(panel_at(12.0), "repulsive"), nullptr);
  EXPECT_NE(end_of(panel_at(-2.0), "repulsive"), nullptr) << "as under the hand, which presses no deeper";
  for (const double z_nm : {12.0, 25.0}) EXPECT_EQ(end_of(panel_at(z_nm), "edge"), nullptr) << z_nm;
}

// A height at which a lever at rest touches the sample: the tip continues to tap, or sticks.
TEST(SwingPanel, ShowsTheEdgeBeyondWhichTheTipSticks) {
  EXPECT_EQ(panel_at(-2.0).stage, "both states exist at this height");
  EXPECT_NE(end_of(panel_at(-2.0), "edge"), nullptr);
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

TEST(SwingPanel, ShowsStatesThatLoseEnergyOffTheCircle) {
  const render::ForcePanel panel = panel_of(sample_with("", "10Pa*s"), 12.0);
  const render::PlotPoint* const end = end_of(panel, "repulsive");
  ASSERT_NE(end, nullptr);
  const double on_circle = 20.0 * end->force_nn / std::hypot(end->place_nm, end->force_nn);
  EXPECT_LT(std::hypot(end->place_nm, end->force_nn), on_circle - 0.1);
}

TEST(SwingPanel, ShowsStatesBesideTheResonance) {
  const curves::SampleModel beside = sample_with("300.1kHz", "");
  const render::ForcePanel free = panel_of(beside, 40.0);
  const double ratio = 300.1 / 300.0;
  expect_hand(free, "free", 20.0, std::atan2(ratio / 400.0, 1.0 - ratio * ratio) / kDegree);
  // values as printed by touchafm curve --mode tapping --at 17nm
  const render::ForcePanel both = panel_of(beside, 17.0);
  EXPECT_EQ(both.stage, "both states exist at this height");
  expect_hand(both, "attractive", 16.910, 125.22);
  expect_hand(both, "repulsive", 18.657, 64.34);
}

// A circle of 52 times the free amplitude: as far as the axes reach, to both sides of the origin.
TEST(SwingPanel, ShowsThePartOfAWideCircleThatItsAxesReach) {
  const render::ForcePanel panel = panel_of(sample_with("282kHz", ""), 25.0);
  const auto arc = std::find_if(panel.curves.begin(), panel.curves.end(),
                                [](const render::PlotCurve& curve) { return curve.label == "\u00d8 991 nm"; });
  ASSERT_NE(arc, panel.curves.end()) << panel.curves.front().label;
  ASSERT_GT(arc->retract.size(), 80U);
  EXPECT_NEAR(arc->retract.front().place_nm, panel.place_min_nm, 1e-6);
  EXPECT_NEAR(arc->retract.back().place_nm, panel.place_max_nm, 1e-6);
  double steepest = 0.0;
  for (const render::PlotPoint& point : arc->retract) steepest = std::max(steepest, point.force_nn);
  EXPECT_GT(steepest, 0.2);
  // a circle of three times the free amplitude is shown as a whole
  const render::ForcePanel near = panel_of(sample_with("299kHz", ""), 25.0);
  EXPECT_GT(near.force_max_nn, 2.8 * 20.0);
}

TEST(SwingPanel, StaysWithinItsAxes) {
  for (const char* drive : {"", "299.5kHz", "299kHz", "285kHz"}) {
    const curves::SampleModel model = sample_with(drive, "");
    for (const double z_nm : {12.0, 17.5, 18.5, 25.0}) {
      const render::ForcePanel panel = panel_of(model, z_nm);
      for (const render::PlotCurve& curve : panel.curves) {
        for (const render::PlotPoint& point : curve.retract) {
          constexpr double kRounding = 1e-9;
          EXPECT_TRUE(
              point.place_nm >= panel.place_min_nm - kRounding && point.place_nm <= panel.place_max_nm + kRounding &&
              point.force_nn >= panel.force_min_nn - kRounding && point.force_nn <= panel.force_max_nn + kRounding)
              << drive << " " << z_nm << " " << curve.label;
        }
      }
    }
  }
}

// One dial for all samples and heights.
TEST(SwingPanel, FollowsTheSampleAndTheHeight) {
  SwingDial dial;
  const curves::SampleModel beside = sample_with("300.1kHz", "");
  for (const double z_nm : {17.5, 25.0, 17.5, 17.5}) {
    for (const curves::SampleModel& model : {sample(), beside}) {
      scene::TipState tip;
      tip.tip.z_m = z_nm * 1e-9;
      const render::ForcePanel kept = dial.panel(model, tip, test::english()), fresh = panel_of(model, z_nm);
      EXPECT_TRUE(kept.curves == fresh.curves) << z_nm;
    }
  }
}

// The panel of the sample names the mean force where that is felt, and the tank that pays for it.
TEST(DataPanel, NamesTheMeanForceThatIsFeltOfALeverThatTaps) {
  curves::TappedHand hand = test::tapped_hand();
  const auto rows_of_felt = [&] {
    const auto model = curves::make_sample_model(curves::tapped_setup(sample().setup.material, hand).value()).value();
    const render::DataPanel panel = data_panel(model, {}, test::english());
    return std::count_if(panel.rows.begin(), panel.rows.end(), [](const render::DataRow& row) {
      return row.value == "mean force on the tip" && row.source.find("30 mJ and 50 mW") != std::string::npos;
    });
  };
  EXPECT_EQ(rows_of_felt(), 0);
  hand.felt = "mean";
  EXPECT_EQ(rows_of_felt(), 1);
  hand.choice.mode = "contact";
  hand.model = "auto";
  hand.values.clear();
  const auto refused = curves::check_contact_mode(hand);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "--felt-force has no effect on --mode contact; add --mode tapping");
}

}  // namespace swing_panel_test
}  // namespace afm::exhibit
