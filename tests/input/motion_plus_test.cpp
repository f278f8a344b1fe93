// SPDX-License-Identifier: Apache-2.0
// A Wii Remote with a MotionPlus, byte by byte as WiiBrew and Linux' hid-wiimote describe them.
// Invariant: a Wii Remote uses its MotionPlus, which is activated again whenever it is plugged in
#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "input/hid_wand.h"
#include "input/wiimote.h"
#include "support/hex_report.h"

namespace afm::input {
namespace motion_plus_test {

using test::from_hex;
using test::Report;
constexpr double kRadPerDegree = std::numbers::pi / 180.0;

// Flat on a table, without dots, with the six bytes of an extension.
Report flat_with(const std::string& extension) {
  return from_hex("37 00 00 80 80 9a ff ff ff ff ff ff ff ff ff ff " + extension);
}
// Identification of an active MotionPlus, a Nunchuk, and a remote with nothing plugged in.
Report identifier(const std::string& bytes) {
  return from_hex("21 00 00 50 00 fa " + bytes + " 00 00 00 00 00 00 00 00 00 00");
}
const Report kMotionPlus = identifier("00 00 a4 20 04 05");
const Report kNunchuk = identifier("00 00 a4 20 00 00");
const Report kNothing = from_hex("21 00 00 57 00 fa 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
const Report kChanged = from_hex("20 00 00 02 00 00 60");
const std::string kAtRest = "00 00 00 83 82 82";  // three times 0x2000, slow

TEST(MotionPlus, SaysThreeRatesOfFourteenBits) {
  // yaw 0x2123 slow, roll 0x1f45 fast, pitch 0x2067 slow
  const auto report = parse_motion_plus(from_hex("23 45 67 87 7c 82"));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->rates, (std::array<std::uint16_t, 3>{0x2067, 0x1f45, 0x2123}));
  EXPECT_EQ(report->slow, (std::array<bool, 3>{true, false, true}));
  const auto largest = parse_motion_plus(from_hex("ff ff ff fc fd fe"));
  ASSERT_TRUE(largest);
  EXPECT_EQ(largest->rates, (std::array<std::uint16_t, 3>{0x3fff, 0x3fff, 0x3fff}));
  EXPECT_EQ(largest->slow, (std::array<bool, 3>{false, false, false}));
}

TEST(MotionPlus, RefusesWhatComesFromBehindItNothingAndTooFewBytes) {
  EXPECT_FALSE(parse_motion_plus(from_hex("23 45 67 87 7c 80")));
  EXPECT_FALSE(parse_motion_plus(from_hex("ff ff ff ff ff ff")));
  EXPECT_FALSE(parse_motion_plus(from_hex("00 00 00 00 00 00")));
  EXPECT_FALSE(parse_motion_plus(from_hex("23 45 67 87 7c")));
}

TEST(MotionPlus, IsBelievedOnceItHasSaidWhatItIs) {
  const auto remote = wiimote_driver();
  EXPECT_FALSE(remote->read(flat_with(kAtRest))->has_gyro);
  remote->read(kNunchuk);
  EXPECT_FALSE(remote->read(flat_with(kAtRest))->has_gyro);
  remote->read(kNothing);
  EXPECT_FALSE(remote->read(flat_with(kAtRest))->has_gyro);
  remote->read(kMotionPlus);
  const auto turned = remote->read(flat_with(kAtRest));
  EXPECT_EQ(turned->imu_count, 1U);
  EXPECT_TRUE(turned->has_gyro);
  EXPECT_EQ(turned->imu[0].rate_rad_per_s, glm::dvec3(0.0));
  EXPECT_EQ(turned->imu[0].acceleration_g, glm::dvec3(0.0, 1.0, 0.0));
}

TEST(MotionPlus, TurnsAboutTheWandsAxesInBothRanges) {
  const auto remote = wiimote_driver();
  remote->read(kMotionPlus);
  // 1024 counts are 55 degrees a second in the fine range and 250 in the coarse one
  const double slow = 55.0 * kRadPerDegree, fast = 250.0 * kRadPerDegree;
  const auto rate = [&](const std::string& extension) {
    return remote->read(flat_with(extension))->imu[0].rate_rad_per_s;
  };
  const auto expect_near = [](const glm::dvec3& a, const glm::dvec3& b) {
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(a[axis], b[axis], 1e-12);
  };
  expect_near(rate("00 00 00 93 82 82"), {0.0, slow, 0.0});  // rotation to the left
  expect_near(rate("00 00 00 91 82 82"), {0.0, fast, 0.0});
  expect_near(rate("00 00 00 83 92 82"), {0.0, 0.0, slow});   // counterclockwise rotation for the hand
  expect_near(rate("00 00 00 83 82 92"), {-slow, 0.0, 0.0});  // downward rotation
  expect_near(rate("00 00 00 82 82 72"), {fast, 0.0, 0.0});
}

TEST(MotionPlus, KeepsItsTurnWhileSomethingBehindItSpeaks) {
  const auto remote = wiimote_driver();
  remote->read(kMotionPlus);
  const auto between = remote->read(flat_with("10 20 30 41 52 60"));
  ASSERT_TRUE(between);
  EXPECT_EQ(between->imu_count, 0U);
}

TEST(MotionPlus, IsWokenWhenTheRemoteOpensAndWheneverItsPlugChanges) {
  const auto remote = wiimote_driver();
  const auto wakes = [](const std::vector<Report>& reports) {
    std::vector<Report> tail(reports.end() - 4, reports.end());
    EXPECT_EQ(tail[0], from_hex("16 04 a6 00 f0 01 55 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00"));
    EXPECT_EQ(tail[1], from_hex("16 04 a6 00 fe 01 04 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00"));
    EXPECT_EQ(tail[2], from_hex("17 04 a4 00 fa 00 06"));
    EXPECT_EQ(tail[3], from_hex("12 04 37"));
  };
  wakes(remote->set_up());
  remote->read(kMotionPlus);
  EXPECT_TRUE(remote->take_answers().empty());
  EXPECT_TRUE(remote->read(kChanged));
  wakes(remote->take_answers());
  EXPECT_TRUE(remote->take_answers().empty());
  EXPECT_FALSE(remote->read(flat_with(kAtRest))->has_gyro);
}

TEST(Wiimote, HandsEachOfItsButtonsOn) {
  struct {
    unsigned raw;  // second byte times 256 plus the first
    WandButton button;
  } constexpr kRows[]{{0x0800, WandButton::Select},
                      {0x0400, WandButton::Grab},
                      {0x0010, WandButton::Scale},
                      {0x8000, WandButton::Home},
                      {0x1000, WandButton::Recenter}};
  const auto remote = wiimote_driver();
  for (const auto& row : kRows) {
    Report report = from_hex("31 00 00 80 80 9a");
    report[1] = static_cast<std::uint8_t>(row.raw & 0xFFU);
    report[2] = static_cast<std::uint8_t>(row.raw >> 8U);
    EXPECT_EQ(remote->read(report)->buttons, bit(row.button)) << row.raw;
  }
  EXPECT_EQ(remote->read(from_hex("31 00 00 80 80 9a"))->buttons, 0U);
}

TEST(MotionPlus, RefusesShortReports) {
  for (Report report : {kMotionPlus, kChanged, from_hex("35 00 00 80 80 9a 00 00 00 83 82 82 0 0 0 0 0 0 0 0 0 0")}) {
    EXPECT_TRUE(parse_wiimote(report));
    report.pop_back();
    EXPECT_FALSE(parse_wiimote(report));
  }
}

// A quarter turn to the left in a second, which gravity alone cannot show.
TEST(MotionPlus, PointsTheWandWhereItIsTurned) {
  HidWand wand(wiimote_driver(), HandPlace{});
  std::int64_t now_ns = 1'000'000'000;
  const auto take = [&](const Report& report) { EXPECT_TRUE(wand.take(report, now_ns += 10'000'000)); };
  take(kMotionPlus);
  take(flat_with(kAtRest));
  // 90 degrees a second are 1676 counts of the fine range: 0x268c
  for (int i = 0; i < 100; ++i) take(flat_with("8c 00 00 9b 82 82"));
  const glm::dvec3 direction = ray_of(wand.state(now_ns)).direction;
  EXPECT_NEAR(direction.x, -1.0, 0.01);
  EXPECT_NEAR(direction.y, 0.0, 0.01);
  EXPECT_NEAR(direction.z, 0.0, 0.02);
}

}  // namespace motion_plus_test
}  // namespace afm::input
