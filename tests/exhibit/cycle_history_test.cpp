// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/cycle_history.h"

#include <gtest/gtest.h>

namespace afm::exhibit {
namespace cycle_history_test {

constexpr double kHandMPerM = 0.05 / 14e-9;

class CycleHistoryTest : public ::testing::Test {
 protected:
  // The hand goes straight to `to_m`, a sample every tenth of a millimetre.
  void move(double to_m, physics::Phase phase) {
    const double step = to_m > height_m_ ? 0.0001 : -0.0001;
    for (; (to_m - height_m_) / step > 0.5; height_m_ += step) sample(phase);
  }
  void sample(physics::Phase phase) {
    scene::TipSample sample;
    sample.material = material_;
    sample.edit_revision = edit_revision_;
    sample.servo_state = scene::ServoState::Running;
    sample.phase = phase;
    sample.hand_height_m = height_m_;
    sample.tip.z_m = height_m_ / kHandMPerM;
    cycles_.add(sample);
  }
  void cycle() {
    move(0.010, physics::Phase::Free);
    move(-0.010, physics::Phase::Attached);
    move(0.050, physics::Phase::Attached);
    move(0.070, physics::Phase::Free);
  }
  std::size_t points(std::size_t material) const {
    const auto plot = cycles_.curves()[material].plot("", {});
    return plot.approach.size() + plot.retract.size();
  }

  CycleHistory cycles_{2};
  std::int32_t material_ = 0;
  std::uint32_t edit_revision_ = 0;
  double height_m_ = 0.070;
};

TEST_F(CycleHistoryTest, AWholeCycleStaysUntilTheTipTouchesAgain) {
  cycle();
  const std::size_t whole = points(0);
  EXPECT_EQ(cycles_.cycles(), 1);
  move(0.020, physics::Phase::Free);
  EXPECT_GT(points(0), whole);
  move(0.010, physics::Phase::Attached);
  EXPECT_LT(points(0), whole);
  EXPECT_GT(points(0), 500U) << "the approach since the tip let go belongs to the new cycle";
}

TEST_F(CycleHistoryTest, CountsCyclesAndKnowsWhereTheHandGoes) {
  cycle();
  cycle();
  EXPECT_EQ(cycles_.cycles(), 2);
  EXPECT_TRUE(cycles_.ascending());
  move(0.065, physics::Phase::Free);
  EXPECT_FALSE(cycles_.ascending());
}

TEST_F(CycleHistoryTest, AContactRemembersThatItWasPressedUntilItEnds) {
  move(0.010, physics::Phase::Free);
  move(0.001, physics::Phase::Attached);
  EXPECT_FALSE(cycles_.pressed());
  move(-0.010, physics::Phase::Attached);
  EXPECT_TRUE(cycles_.pressed());
  move(0.050, physics::Phase::Attached);
  move(0.040, physics::Phase::Attached);  // jerk by the pull
  EXPECT_TRUE(cycles_.pressed());
  move(0.070, physics::Phase::Free);
  EXPECT_FALSE(cycles_.pressed());
}

TEST_F(CycleHistoryTest, TheTremorOfAHandIsNoTurn) {
  cycle();
  for (int i = 0; i < 1000; ++i) {
    height_m_ += i % 2 == 0 ? -0.0005 : 0.0005;
    sample(physics::Phase::Free);
    EXPECT_TRUE(cycles_.ascending());
  }
}

TEST_F(CycleHistoryTest, AHandAtRestAddsNothing) {
  cycle();
  const std::size_t whole = points(0);
  for (int i = 0; i < 100'000; ++i) sample(physics::Phase::Free);
  EXPECT_LE(points(0), whole + 1);
}

TEST_F(CycleHistoryTest, KeepsTheOtherMaterialAndForgetsWhatOtherParametersGave) {
  cycle();
  material_ = 1;
  cycle();
  EXPECT_GT(points(0), 100U);
  edit_revision_ = 1;
  sample(physics::Phase::WaitForLift);
  EXPECT_EQ(points(1), 0U);
  EXPECT_EQ(cycles_.cycles(), 0);
  EXPECT_GT(points(0), 100U);
}

}  // namespace cycle_history_test
}  // namespace afm::exhibit
