// SPDX-License-Identifier: Apache-2.0
// Invariant: the friction loop on the wall is that of its session, with the figures of the last closed one
#include "exhibit/friction/friction_panel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "physics/friction/anchored_tip.h"
#include "physics/friction/friction_loop.h"
#include "support/phrases.h"

// The friction loop that F shows, of a tip that rubs with 0.7 nN on a spring of 3 N/m.
namespace afm::exhibit {
namespace friction_panel_test {

using physics::FrictionLaw;
using physics::Length;

constexpr double kStrokeM = 10e-9;
constexpr int kTicks = 500;  // number per stroke
constexpr double kPeriodM = 0.5e-9;

// The servo's output while a hand leads the tip along a line of this direction.
class Led {
 public:
  explicit Led(FrictionHistory& history, double angle_rad = 0.0) : history_(history), angle_rad_(angle_rad) {}

  void land() {
    tip_.land({});
    add(0.0, physics::Phase::Attached);
  }
  void lift() { add(at_m_, physics::Phase::Free); }
  void to(double end_m) {
    const double begin_m = at_m_;
    for (int i = 1; i <= kTicks; ++i) add(begin_m + (end_m - begin_m) * i / kTicks, physics::Phase::Attached);
  }
  void there_and_back() {
    to(kStrokeM);
    to(0.0);
  }

  std::uint32_t edit_revision = 0;

 private:
  void add(double at_m, physics::Phase phase) {
    at_m_ = at_m;
    const double x_m = std::cos(angle_rad_) * at_m, y_m = std::sin(angle_rad_) * at_m;
    tip_.move_to({Length(x_m), Length(y_m)}, physics::Force(0.7e-9));
    scene::TipSample sample;
    sample.material = 0;
    sample.edit_revision = edit_revision;
    sample.phase = phase;
    sample.surface.xy_m = {x_m, y_m};
    if (phase == physics::Phase::Attached) sample.lateral_force_n = {tip_.force().x.si, tip_.force().y.si};
    history_.add(sample);
  }

  FrictionHistory& history_;
  double angle_rad_;
  physics::AnchoredTip tip_{physics::Stiffness(3.0)};
  double at_m_ = 0;
};

render::ForcePanel panel_of(const FrictionHistory& history, FrictionLaw law = FrictionLaw::Amontons) {
  physics::FrictionParameters friction;
  friction.law = law;
  friction.period = Length(kPeriodM);
  return friction_panel(history, friction, test::english());
}

std::vector<std::string> values(const render::ForcePanel& panel) {
  std::vector<std::string> texts;
  for (const render::DataRow& figure : panel.figures) texts.push_back(figure.name + " " + figure.value);
  return texts;
}

TEST(FrictionPanel, SaysWithFrictionOffHowItIsTurnedOn) {
  const FrictionHistory history;
  const render::ForcePanel panel = panel_of(history, FrictionLaw::None);
  EXPECT_EQ(panel.stage, "Friction is off: start with --friction lattice");
  EXPECT_TRUE(panel.figures.empty() && panel.curves.empty());
}

TEST(FrictionPanel, GrowsAndHasNoFiguresBeforeTheLoopIsClosed) {
  FrictionHistory history;
  Led hand(history);
  EXPECT_EQ(panel_of(history).stage, "rub the tip back and forth on the surface");
  hand.land();
  hand.to(kStrokeM);
  const render::ForcePanel panel = panel_of(history);
  ASSERT_EQ(panel.curves.size(), 1U);
  EXPECT_EQ(panel.curves[0].label, "now");
  EXPECT_EQ(panel.curves[0].retract.size(), kTicks + 1U);
  EXPECT_TRUE(panel.figures.empty());
  ASSERT_TRUE(panel.cursor);
  EXPECT_NEAR(panel.cursor->place_nm, 10.0, 1e-9);
  EXPECT_NEAR(panel.cursor->force_nn, 0.7, 1e-9);
  hand.lift();
  EXPECT_FALSE(panel_of(history).cursor);
}

TEST(FrictionPanel, HasHalfWidthOffsetAndSlopeOfTheLastLoopAlongAnyLine) {
  for (const double angle_rad : {0.0, 0.6, 1.5, -1.2}) {
    FrictionHistory history;
    Led hand(history, angle_rad);
    hand.land();
    for (int i = 0; i < 3; ++i) hand.there_and_back();
    const render::ForcePanel panel = panel_of(history);
    const auto figures = values(panel);
    ASSERT_EQ(figures.size(), 3U) << angle_rad;
    EXPECT_EQ(figures[0], "half width 700 pN") << angle_rad;
    EXPECT_EQ(figures[1].substr(0, 7), "offset ") << angle_rad;
    EXPECT_EQ(figures[2], "slope 3 N/m") << angle_rad;
    ASSERT_EQ(panel.curves.size(), 2U) << angle_rad;
    EXPECT_EQ(panel.curves[0].label, "to the right");
    EXPECT_EQ(panel.curves[1].label, "to the left");
    EXPECT_FALSE(panel.curves[0].retract.empty());
    EXPECT_FALSE(panel.curves[1].approach.empty()) << "dashed, so that the strokes differ in more than colour";
    ASSERT_EQ(panel.markers.size(), 3U);
    EXPECT_NEAR(panel.markers[0].value, 0.7, 1e-3);
    EXPECT_NEAR(panel.markers[2].value, -0.7, 1e-3);
  }
}

TEST(FrictionPanel, ShowsTheLastLoopWhileTheNextStrokeStillSticks) {
  FrictionHistory history;
  Led hand(history);
  hand.land();
  hand.there_and_back();
  hand.there_and_back();
  hand.to(1.01e-9);  // farther than a turn, but not as far as the tip sticks at both ends
  const render::ForcePanel panel = panel_of(history);
  ASSERT_EQ(panel.curves.size(), 3U);
  EXPECT_EQ(panel.curves[2].label, "now");
  EXPECT_EQ(values(panel)[0], "half width 700 pN");
}

TEST(FrictionPanel, KeepsTheLoopOfTheContactBeforeUntilAnotherIsClosedOrTheParametersChange) {
  FrictionHistory history;
  Led hand(history);
  hand.land();
  hand.there_and_back();
  hand.there_and_back();
  hand.lift();
  hand.land();
  hand.to(3e-9);
  EXPECT_EQ(panel_of(history).figures.size(), 3U);
  EXPECT_EQ(panel_of(history).curves.size(), 3U);
  hand.lift();
  hand.land();
  EXPECT_EQ(panel_of(history).figures.size(), 3U) << "a contact without a loop does not replace it";
  hand.edit_revision = 1;
  hand.to(1e-9);
  EXPECT_TRUE(panel_of(history).figures.empty());
}

// Twenty atoms in a stroke: a panel of all of them would be a block of colour.
TEST(FrictionPanel, ShowsThreePeriodsOfALatticeAroundTheTipInWholePeriods) {
  FrictionHistory history;
  Led hand(history);
  hand.land();
  hand.to(2.9e-9);
  EXPECT_EQ(panel_of(history, FrictionLaw::Lattice).stage, "rub the tip back and forth on the surface");
  EXPECT_EQ(panel_of(history, FrictionLaw::Lattice).curves[0].retract.size(), kTicks + 1U) << "short enough";
  hand.to(kStrokeM);
  hand.to(0.0);
  hand.there_and_back();
  for (const double at_m : {3.1e-9, 3.4e-9}) {
    hand.to(at_m);
    const render::ForcePanel panel = panel_of(history, FrictionLaw::Lattice);
    EXPECT_EQ(panel.stage, "3 of 20 periods");
    EXPECT_EQ(values(panel)[0], "half width 700 pN") << "of the whole loop";
    for (const render::PlotCurve& curve : panel.curves) {
      for (const auto* points : {&curve.approach, &curve.retract}) {
        for (const render::PlotPoint& point : *points) {
          EXPECT_GE(point.place_nm, 2.5 - 1e-9);
          EXPECT_LE(point.place_nm, 4.0 + 1e-9);
        }
      }
    }
    EXPECT_NEAR(panel.place_max_nm - panel.place_min_nm, 1.5 * 1.16, 0.05);
  }
  EXPECT_GT(panel_of(history).place_max_nm, 9.0) << "another law has no periods";
  hand.lift();
  EXPECT_LT(panel_of(history, FrictionLaw::Lattice).place_max_nm, 6.6) << "around the middle";
}

TEST(FrictionHistory, IsBoundedHoweverLongTheTipIsLedAndEmptyWhereItRests) {
  FrictionHistory history;
  Led hand(history);
  hand.land();
  for (int i = 0; i < 100; ++i) hand.there_and_back();
  EXPECT_LE(history.contact().size(), FrictionHistory::kMostPoints);
  EXPECT_EQ(values(panel_of(history))[0], "half width 700 pN");
  const std::size_t before = history.contact().size();
  for (int i = 0; i < 10; ++i) hand.to(0.0);
  EXPECT_EQ(history.contact().size(), before);
}

}  // namespace friction_panel_test
}  // namespace afm::exhibit
