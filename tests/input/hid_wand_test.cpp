// SPDX-License-Identifier: Apache-2.0
#include "input/hid_wand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "input/dualsense.h"
#include "input/spacemouse.h"

namespace afm::input {
namespace hid_wand_test {

using Report = std::vector<std::uint8_t>;

constexpr std::int64_t kMillisecond = 1'000'000;
constexpr HandPlace kHand{.position_m = {0.5, 1.2, 2.0}, .forward = {0.0, 0.0, -1.0}};

Report push_report(int x, int y, int z) {
  Report report{1};
  for (const int value : {x, y, z}) {
    report.push_back(static_cast<std::uint8_t>(value & 0xFF));
    report.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
  }
  return report;
}

Report buttons_report(unsigned buttons) { return {3, static_cast<std::uint8_t>(buttons), 0}; }

TEST(HidWand, OfACapPointsStraightAheadUntilItIsPushed) {
  HidWand wand(spacemouse_driver(), kHand);
  const WandState state = wand.state(0);
  EXPECT_TRUE(state.orientation_valid);
  EXPECT_FALSE(state.position_valid);
  EXPECT_EQ(state.motion, WandMotion::Rate);
  EXPECT_EQ(state.position_m, kHand.position_m);
  EXPECT_NEAR(glm::length(ray_of(state).direction - glm::dvec3(0, 0, -1)), 0.0, 1e-12);
}

TEST(HidWand, OfACapIsSteeredByPushingAtASpeedThatIgnoresHowOftenItIsAsked) {
  std::vector<double> reached;
  for (const std::int64_t step : {2 * kMillisecond, 50 * kMillisecond}) {
    HidWand wand(spacemouse_driver(), kHand);
    ASSERT_TRUE(wand.take(push_report(350, 0, 0), 1));
    for (std::int64_t now = step; now <= 500 * kMillisecond; now += step) wand.state(now);
    const glm::dvec3 direction = ray_of(wand.state(500 * kMillisecond)).direction;
    EXPECT_GT(direction.x, 0.4) << "to the right, where it is pushed";
    EXPECT_NEAR(direction.y, 0.0, 1e-12);
    reached.push_back(direction.x);
  }
  EXPECT_NEAR(reached[0], reached[1], 1e-6);
}

TEST(HidWand, OfACapDoesNotMoveWhileItMovesTheScene) {
  HidWand wand(spacemouse_driver(), kHand);
  wand.take(buttons_report(2), 0);
  wand.take(push_report(350, 0, 0), kMillisecond);
  const WandState state = wand.state(400 * kMillisecond);
  EXPECT_TRUE(state.pressed(WandButton::Grab));
  EXPECT_EQ(state.push, glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_NEAR(ray_of(state).direction.x, 0.0, 1e-12);
}

TEST(HidWand, OfACapGoesHomeWhenTheGrabButtonIsPressedTwice) {
  HidWand wand(spacemouse_driver(), kHand);
  wand.take(push_report(350, 0, 0), 0);
  wand.state(100 * kMillisecond);
  wand.take(push_report(0, 0, 0), 101 * kMillisecond);
  wand.take(buttons_report(2), 1000 * kMillisecond);
  wand.take(buttons_report(0), 1100 * kMillisecond);
  EXPECT_GT(ray_of(wand.state(1150 * kMillisecond)).direction.x, 0.05);
  wand.take(buttons_report(2), 1200 * kMillisecond);
  const WandState home = wand.state(1201 * kMillisecond);
  EXPECT_TRUE(home.pressed(WandButton::Home));
  EXPECT_FALSE(home.pressed(WandButton::Grab));
  EXPECT_NEAR(ray_of(home).direction.x, 0.0, 1e-12) << "and points straight ahead again";
  wand.take(buttons_report(0), 1300 * kMillisecond);
  wand.take(buttons_report(2), 2000 * kMillisecond);
  EXPECT_TRUE(wand.state(2000 * kMillisecond).pressed(WandButton::Grab)) << "slowly, it grabs";
}

TEST(HidWand, KeepsItsStateWhenAReportIsDamaged) {
  HidWand wand(spacemouse_driver(), kHand);
  wand.take(buttons_report(1), 5);
  EXPECT_FALSE(wand.take(Report{1, 0x5e}, 10));
  EXPECT_FALSE(wand.take(Report{}, 10));
  const WandState state = wand.state(10);
  EXPECT_TRUE(state.pressed(WandButton::Select));
  EXPECT_EQ(state.time_ns, 5);
}

Report dualsense_report(std::int16_t yaw_counts, std::uint8_t buttons1) {
  Report report(64, 0);
  report[0] = 1;
  for (const std::size_t stick : {1U, 2U, 3U, 4U}) report[stick] = 128;
  report[8] = 8;
  report[9] = buttons1;
  report[18] = static_cast<std::uint8_t>(yaw_counts & 0xFF);
  report[19] = static_cast<std::uint8_t>((yaw_counts >> 8) & 0xFF);
  report[25] = 0x20;
  return report;
}

TEST(HidWand, WithAMotionSensorPointsWhereItIsTurnedAndIsRecentred) {
  constexpr HandPlace to_the_left{.position_m = {0.0, 1.0, 0.0}, .forward = {-1.0, 0.0, 0.0}};
  HidWand wand(dualsense_driver(), to_the_left);
  EXPECT_FALSE(wand.state(0).orientation_valid);
  std::int64_t now = kMillisecond;
  wand.take(dualsense_report(0, 0), now);
  EXPECT_NEAR(glm::length(ray_of(wand.state(now)).direction - glm::dvec3(-1, 0, 0)), 0.0, 1e-9);
  // a quarter of a second at 100 degrees a second to the left
  for (int i = 0; i < 63; ++i) wand.take(dualsense_report(1600, 0), now += 4 * kMillisecond);
  const glm::dvec3 turned = ray_of(wand.state(now)).direction;
  EXPECT_NEAR(std::atan2(turned.z, -turned.x), 0.44, 0.01) << "from -x towards +z";
  wand.take(dualsense_report(0, 0x20), now += 4 * kMillisecond);
  EXPECT_NEAR(glm::length(ray_of(wand.state(now)).direction - glm::dvec3(-1, 0, 0)), 0.0, 1e-6);
}

TEST(RateResponse, IsOddDeadInTheMiddleAndGrowsToOne) {
  EXPECT_EQ(rate_response(0.1), 0.0);
  EXPECT_EQ(rate_response(-0.05), 0.0);
  EXPECT_NEAR(rate_response(1.0), 1.0, 1e-12);
  EXPECT_EQ(rate_response(3.0), rate_response(1.0));
  EXPECT_NEAR(rate_response(0.55), 0.2227, 1e-4);  // half of the way: (exp(1.25) - 1) / (exp(2.5) - 1)
  EXPECT_EQ(rate_response(-0.6), -rate_response(0.6));
  EXPECT_EQ(rate_response(std::nan("")), 0.0);
  for (double d = 0.12; d < 1.0; d += 0.01) {
    EXPECT_GT(rate_response(d), rate_response(d - 0.01));
    EXPECT_LT(rate_response(d), d);
  }
}

}  // namespace hid_wand_test
}  // namespace afm::input
