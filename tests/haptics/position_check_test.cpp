// SPDX-License-Identifier: Apache-2.0
#include "haptics/position_check.h"

#include <gtest/gtest.h>

namespace afm::haptics {
namespace position_check_test {

constexpr std::int64_t kTickNs = 1'000'000;
const glm::dvec3 kNone(0.0), kPull(0.0, -0.4, 0.0);

class PlausiblePlaces : public testing::Test {
 protected:
  DeviceSample at(double height_m, const glm::dvec3& force_n = kPull, std::int64_t elapsed_ns = kTickNs) {
    return check.checked({.position_m = {0.0, height_m, 0.0}}, elapsed_ns, force_n);
  }
  // Number of ticks until the device counts as failed; -1: more than 100.
  template <class Height>
  int ticks_until_unhealthy(Height&& height_m, double believed_m) {
    for (int tick = 1; tick <= 100; ++tick) {
      const DeviceSample sample = at(height_m(tick));
      if (!sample.healthy) return tick;
      if (sample.position_m.y != believed_m) ADD_FAILURE() << "tick " << tick << ": " << sample.position_m.y << " m";
    }
    return -1;
  }

  PositionCheck check{true};
};

TEST_F(PlausiblePlaces, AHandMayBeAsFastAsHandsAre) {
  at(0.0);
  for (int tick = 1; tick < 200; ++tick) {
    const DeviceSample sample = at(1.5e-3 * tick);
    ASSERT_TRUE(sample.healthy);
    ASSERT_EQ(sample.position_m.y, 1.5e-3 * tick);
  }
}

TEST_F(PlausiblePlaces, ADeviceMayTellItsPlaceEveryEightMilliseconds) {
  at(0.0);
  for (int tick = 1; tick < 400; ++tick) {
    const double told_m = 0.8e-3 * (tick / 8 * 8);
    const DeviceSample sample = at(told_m);
    ASSERT_TRUE(sample.healthy);
    ASSERT_EQ(sample.position_m.y, told_m) << tick;
  }
}

TEST_F(PlausiblePlaces, ALateTickMayFindTheHandElsewhere) {
  at(0.0);
  EXPECT_EQ(at(0.04, kPull, 50 * kTickNs).position_m.y, 0.04);
}

TEST_F(PlausiblePlaces, OneWildPlaceIsPassedOver) {
  for (int tick = 0; tick < 300; ++tick) {
    const bool wild = tick % 50 == 25;
    const DeviceSample sample = at((wild ? 0.05 : 0.0) + 1e-7 * (tick % 2));
    ASSERT_TRUE(sample.healthy) << tick;
    ASSERT_LT(sample.position_m.y, 1e-6) << tick;
  }
}

TEST_F(PlausiblePlaces, AJumpIsNotBelievedAndEndsTheForce) {
  at(0.0);
  EXPECT_EQ(ticks_until_unhealthy([](int) { return 0.045; }, 0.0), 4);
  // the check restarts at the device's current position
  EXPECT_EQ(at(0.045).position_m.y, 0.045);
  EXPECT_TRUE(at(0.0451).healthy);
}

TEST_F(PlausiblePlaces, JumpsToAndFroAreNotBelievedAndEndTheForce) {
  at(0.0);
  const int ticks = ticks_until_unhealthy([](int tick) { return tick % 2 == 1 ? 0.005 : 0.0; }, 0.0);
  EXPECT_GT(ticks, 0);
  EXPECT_LE(ticks, 20);
}

TEST_F(PlausiblePlaces, StandingStillUnderForceForASecondEndsIt) {
  for (int tick = 0; tick < 999; ++tick) ASSERT_TRUE(at(0.02).healthy) << tick;
  EXPECT_TRUE(at(0.02).healthy);
  EXPECT_FALSE(at(0.02).healthy);
}

TEST_F(PlausiblePlaces, AFlickerOfTheLastBitIsEnough) {
  for (int tick = 0; tick < 5000; ++tick) ASSERT_TRUE(at(tick % 900 == 0 ? 0.02 : 0.020000001).healthy) << tick;
}

TEST_F(PlausiblePlaces, WithoutForceADeviceMayLieStill) {
  for (int tick = 0; tick < 5000; ++tick) ASSERT_TRUE(at(0.02, kNone).healthy) << tick;
}

TEST(PlausiblePlacesOfExactDevices, AreAllBelieved) {
  PositionCheck exact(false);
  for (int tick = 0; tick < 3000; ++tick) {
    const DeviceSample sample = exact.checked({.position_m = {0.0, tick < 1500 ? 0.0 : 0.1, 0.0}}, kTickNs, kPull);
    ASSERT_TRUE(sample.healthy);
    ASSERT_EQ(sample.position_m.y, tick < 1500 ? 0.0 : 0.1);
  }
}

}  // namespace position_check_test
}  // namespace afm::haptics
