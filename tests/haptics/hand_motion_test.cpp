// SPDX-License-Identifier: Apache-2.0
#include "haptics/hand_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hand_motion_test {

using afm::haptics::HandMotion;

constexpr std::int64_t kPeriodNs = 1'000'000;

// At 2 m/s the filter passes 0.8 m/s in its third millisecond: 1 - e^(-2 pi 30 Hz 3 ms) = 0.432 > 0.8/2 > 0.314. From
// the tick that first sees it the hand is let off for kTripNs.
TEST(HandMotion, IsTooFastFiveMillisecondsAfterTheTickThatFirstSawIt) {
  HandMotion motion(0.8);
  glm::dvec3 place_m(0.0);
  motion.move(place_m, kPeriodNs);
  for (int ms = 1; ms <= 8; ++ms) {
    EXPECT_FALSE(motion.too_fast()) << ms;
    motion.move(place_m += glm::dvec3(0.0, 2e-3, 0.0), kPeriodNs);
    EXPECT_EQ(motion.velocity_m_per_s().y > 0.8, ms >= 3) << ms;
  }
  EXPECT_TRUE(motion.too_fast());
}

TEST(HandMotion, IsNotTooFastForOneWildSample) {
  HandMotion motion(0.8);
  motion.move({}, kPeriodNs);
  motion.move({0.01, 0.0, 0.0}, kPeriodNs);
  for (int ms = 0; ms < 100; ++ms) {
    motion.move({}, kPeriodNs);
    EXPECT_FALSE(motion.too_fast());
  }
}

TEST(HandMotion, FollowsASteadyHandAndForgetsIt) {
  HandMotion motion(0.8);
  for (int ms = 0; ms < 200; ++ms) motion.move({0.0, 0.0, 0.3e-3 * ms}, kPeriodNs);
  EXPECT_NEAR(motion.velocity_m_per_s().z, 0.3, 1e-9);
  motion.forget();
  EXPECT_EQ(motion.velocity_m_per_s(), glm::dvec3(0.0));
  motion.move({1.0, 0.0, 0.0}, kPeriodNs);
  EXPECT_EQ(motion.moved_m(), glm::dvec3(0.0));
}

}  // namespace hand_motion_test
