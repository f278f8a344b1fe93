// SPDX-License-Identifier: Apache-2.0
// Places and forces along the library's axes, and places where no hand can be.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "dhd_bench.h"

namespace dhd_places_test {

using namespace afm::haptics;
using afm::scene::FaultCode;
using afm::test::DhdBench;
using afm::test::DhdMock;

TEST(DhdPlaces, AreTurnedIntoTheFrameOfTheRoomWithTheButton) {
  DhdBench bench;
  mock_dhd_set_position(0.030, -0.010, 0.020);  // towards the user, left, up
  mock_dhd_set_buttons(1);
  bench.driver_tick();
  DeviceSample sample = bench.device->read(bench.clock.now_ns());
  EXPECT_TRUE(sample.healthy);
  EXPECT_TRUE(sample.turn_on);
  EXPECT_NEAR(glm::distance(sample.position_m, glm::dvec3(-0.010, 0.020, 0.030)), 0.0, 2e-7);
  mock_dhd_set_buttons(2);
  bench.driver_tick();
  EXPECT_FALSE(bench.device->read(bench.clock.now_ns()).turn_on);
}

TEST(DhdPlaces, PullDownwardsAlongTheLibrarysAxes) {
  DhdBench bench;
  bench.hold_attached();
  const auto force = DhdMock::force();
  EXPECT_LT(force[2], -0.5);  // downward force
  EXPECT_NEAR(std::hypot(force[0], force[1]), 0.0, 1e-3);
}

// The walls at the ends of the workspace push to the left, and away from the user.
TEST(DhdPlaces, PushSidewaysAlongTheLibrarysAxes) {
  for (const auto& [right_mm, near_mm, pushed, other] :
       {std::tuple(73.0, 0.0, 1U, 0U), std::tuple(0.0, 73.0, 0U, 1U)}) {
    DhdBench bench;
    bench.arm();
    for (double share = 0; share <= 1.0; share += 0.001) {
      DhdMock::set_position(share * right_mm, DhdBench::kContactMm + 60, share * near_mm);
      bench.tick();
    }
    bench.run(100);
    const auto force = DhdMock::force();
    EXPECT_LT(force[pushed], -0.2);
    EXPECT_NEAR(std::hypot(force[other], force[2]), 0.0, 0.05);
  }
}

TEST(DhdPlaces, OfNoNumberAndLeapsAreComparedWithNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [x, y] : {std::pair(nan, 0.0), std::pair(0.0, infinity), std::pair(0.0, 1000.0),
                             std::pair(-1e300, 0.0), std::pair(60.0, 0.0)}) {
    SCOPED_TRACE(testing::Message() << x << ' ' << y);
    DhdBench bench;
    bench.hold_attached();
    const double height_m = bench.device->read(bench.clock.now_ns()).position_m.y;
    DhdMock::set_position(x, y, 0);
    bench.run(1);
    EXPECT_EQ(bench.health(), DhdHealth::ImplausiblePosition);
    const DeviceSample sample = bench.device->read(bench.clock.now_ns());
    EXPECT_FALSE(sample.healthy);
    EXPECT_NEAR(sample.position_m.y, height_m, 1e-6);
    EXPECT_EQ(bench.felt(), 0.0);
    DhdMock::set_position(0, DhdBench::kContactMm + 25, 0);
    bench.run(250);
    EXPECT_EQ(bench.health(), DhdHealth::Ready);
    EXPECT_EQ(bench.felt(), 0.0);
  }
}

TEST(DhdPlaces, LoseTheirForceWhenTheSensorFreezes) {
  DhdBench bench;
  bench.hold_attached();
  mock_dhd_hold_still();
  bench.run(990);
  EXPECT_GT(bench.felt(), 0.5);
  bench.run(20);
  EXPECT_EQ(bench.felt(), 0.0);
  EXPECT_EQ(bench.state().fault, FaultCode::DeviceError);
}

}  // namespace dhd_places_test
