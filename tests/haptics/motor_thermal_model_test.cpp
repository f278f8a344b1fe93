// SPDX-License-Identifier: Apache-2.0
#include "haptics/motor_thermal_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace motor_thermal_model_test {

using afm::haptics::MotorThermalModel;

constexpr double kRatingN = 0.88;
constexpr double kCapN = 2.0;
constexpr double kPeriodS = 1e-3;

// Holds a wanted force, as far as the budget lets it.
double hold(MotorThermalModel& motors, double wanted_n, double seconds) {
  double force_n = 0.0;
  for (double t = 0.0; t < seconds; t += kPeriodS) {
    force_n = motors.gain() * wanted_n;
    motors.update(force_n, kPeriodS, 0.0);
  }
  return force_n;
}

TEST(MotorThermalModel, EndsAtTheRatingWhateverIsHeldIndefinitely) {
  for (const double wanted_n : {1.0, 1.5, 2.0}) {
    MotorThermalModel motors(kRatingN, kCapN);
    const double force_n = hold(motors, wanted_n, 600.0);
    EXPECT_LE(force_n, kRatingN);
    EXPECT_GE(force_n, 0.9 * kRatingN) << "colder than it has to be";
    EXPECT_LT(motors.heat(), MotorThermalModel::kHot);
  }
}

TEST(MotorThermalModel, LeavesAForceThatTheMotorsCanHoldIndefinitely) {
  MotorThermalModel motors(kRatingN, kCapN);
  const double wanted_n = 0.88 * kRatingN;
  EXPECT_EQ(hold(motors, wanted_n, 600.0), wanted_n);
}

// Four seconds of the strongest pull, as in a slow cycle, cost nothing.
TEST(MotorThermalModel, LeavesTheWholeForceForSomeSeconds) {
  MotorThermalModel motors(kRatingN, kCapN);
  EXPECT_EQ(hold(motors, kCapN, 4.0), kCapN);
}

TEST(MotorThermalModel, NeverStepsTheForce) {
  MotorThermalModel motors(kRatingN, kCapN);
  double before_n = hold(motors, kCapN, kPeriodS);
  for (int i = 0; i < 100'000; ++i) {
    const double force_n = hold(motors, kCapN, kPeriodS);
    ASSERT_LT(std::abs(force_n - before_n), 1e-3);
    before_n = force_n;
  }
}

TEST(MotorThermalModel, RecoversWithoutForce) {
  MotorThermalModel motors(kRatingN, kCapN);
  hold(motors, kCapN, 120.0);
  ASSERT_LT(motors.gain(), 0.5);
  hold(motors, 0.0, 10.0);
  EXPECT_EQ(motors.gain(), 1.0);
}

TEST(MotorThermalModel, HeatsLikeOneThermalMass) {
  MotorThermalModel motors(kRatingN, kCapN);
  for (int i = 0; i < 30'000; ++i) motors.update(0.5 * kRatingN, kPeriodS, 0.0);
  EXPECT_NEAR(motors.heat(), 0.25 * (1.0 - std::exp(-1.0)), 1e-9);
  // one long tick heats as much as many short ones
  MotorThermalModel other(kRatingN, kCapN);
  other.update(0.5 * kRatingN, 30.0, 0.0);
  EXPECT_NEAR(other.heat(), motors.heat(), 1e-9);
}

TEST(MotorThermalModel, BelievesADeviceThatMeasuresMoreAndNotWhatIsNoNumber) {
  MotorThermalModel motors(kRatingN, kCapN);
  motors.update(0.0, kPeriodS, 0.9);
  EXPECT_NEAR(motors.heat(), 0.9, 1e-12);
  EXPECT_LT(motors.gain(), 1.0);
  motors.update(0.0, kPeriodS, 7.0);
  EXPECT_EQ(motors.heat(), MotorThermalModel::kHot);
  EXPECT_NEAR(motors.gain() * kCapN, 0.9 * kRatingN, 1e-12);
  motors.update(0.0, kPeriodS, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(motors.gain(), 1.0);
}

TEST(MotorThermalModel, SimulatesNothingForADeviceWithoutARating) {
  MotorThermalModel motors(0.0, kCapN);
  EXPECT_EQ(hold(motors, kCapN, 100.0), kCapN);
  EXPECT_EQ(motors.heat(), 0.0);
}

}  // namespace motor_thermal_model_test
