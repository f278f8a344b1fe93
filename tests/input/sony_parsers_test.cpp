// SPDX-License-Identifier: Apache-2.0
// DualSense and PS Move: reports and the calibration that the devices keep.
#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "input/dualsense.h"
#include "input/psmove.h"
#include "input/wand.h"

namespace afm::input {
namespace sony_parsers_test {

using Report = std::vector<std::uint8_t>;
constexpr double kRadPerDegree = std::numbers::pi / 180.0;

// ---- DualSense ----

Report dualsense_bluetooth() {
  Report report(78, 0);
  report[0] = 0x31;
  report[2] = 200;        // left stick to the right
  report[9] = 0x28;       // cross
  report[23 + 3] = 0x20;  // 8192 along y
  const std::uint32_t crc = sony_crc32(0xA1, Bytes(report).first(74));
  for (std::size_t i = 0; i < 4; ++i) report[74 + i] = static_cast<std::uint8_t>(crc >> (8 * i));
  return report;
}

TEST(DualSense, IsBelievedOverBluetoothOnlyWithItsChecksum) {
  Report report = dualsense_bluetooth();
  const auto good = parse_dualsense(report);
  ASSERT_TRUE(good);
  EXPECT_EQ(good->left_stick[0], 200);
  EXPECT_EQ(good->acceleration[1], 8192);
  for (const std::size_t damaged : {1U, 30U, 77U}) {
    Report bad = report;
    bad[damaged] ^= 0x10;
    EXPECT_FALSE(parse_dualsense(bad)) << damaged;
  }
  report.pop_back();
  EXPECT_FALSE(parse_dualsense(report));
}

// The check value of CRC-32, of "123456789".
TEST(DualSense, HasTheChecksumOfTheStandard) {
  const std::string rest = "23456789";
  EXPECT_EQ(sony_crc32('1', Bytes(reinterpret_cast<const std::uint8_t*>(rest.data()), rest.size())), 0xCBF43926U);
}

TEST(DualSense, AtRestFeelsOneGUpwards) {
  const auto driver = dualsense_driver();
  const auto input = driver->read(dualsense_bluetooth());
  ASSERT_TRUE(input && input->imu_count == 1);
  EXPECT_NEAR(input->imu[0].acceleration_g.y, 1.0, 1e-12);
  EXPECT_EQ(input->buttons, bit(WandButton::Select));
  EXPECT_NEAR(input->push->x, 72.0 / 127.0, 1e-12);
}

TEST(DualSense, CalibrationTurnsCountsIntoDegreesASecond) {
  Report report(41, 0);
  report[0] = 5;
  const auto put = [&](std::size_t at, std::int16_t value) {
    report[at] = static_cast<std::uint8_t>(value & 0xFF);
    report[at + 1] = static_cast<std::uint8_t>((value >> 8) & 0xFF);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    put(1 + 2 * i, 7);
    put(7 + 4 * i, 8847);
    put(9 + 4 * i, -8833);
    put(23 + 4 * i, 8200);
    put(25 + 4 * i, -8184);
  }
  put(19, 540);
  put(21, 540);
  const DualSenseCalibration calibration = parse_dualsense_calibration(report);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR((8847 - calibration.gyro_bias[i]) * calibration.gyro_gain[i], 540.0 * kRadPerDegree, 1e-9);
    EXPECT_NEAR((8200 - calibration.acceleration_bias[i]) * calibration.acceleration_gain[i], 1.0, 1e-12);
    EXPECT_NEAR((-8184 - calibration.acceleration_bias[i]) * calibration.acceleration_gain[i], -1.0, 1e-12);
  }
}

TEST(DualSense, CalibrationWithoutSenseLeavesNominalNumbers) {
  Report zeros(41, 0);
  zeros[0] = 5;
  for (const Report& report : {Report{}, Report{5, 1}, zeros}) {
    const DualSenseCalibration calibration = parse_dualsense_calibration(report);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(calibration.gyro_gain[i], kRadPerDegree / 16.0, 1e-15);
      EXPECT_NEAR(calibration.acceleration_gain[i], 1.0 / 8192.0, 1e-15);
    }
  }
}

// ---- PS Move ----

void put16(Report& report, std::size_t at, int value) {
  report[at] = static_cast<std::uint8_t>(value & 0xFF);
  report[at + 1] = static_cast<std::uint8_t>((value >> 8) & 0xFF);
}

TEST(PsMove, CountsFromTheMiddleInItsFirstModelAndFromZeroInItsSecond) {
  Report report(49, 0);
  report[0] = 1;
  put16(report, 13, 0x8000 + 4326);
  put16(report, 25, 0x8000 - 100);
  const auto first = parse_psmove(PsMoveModel::Zcm1, report);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->acceleration[0][0], 4326);
  EXPECT_EQ(first->gyro[0][0], -100);
  put16(report, 13, -4326);
  const auto second = parse_psmove(PsMoveModel::Zcm2, report);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->acceleration[0][0], -4326);
  report.resize(48);
  EXPECT_FALSE(parse_psmove(PsMoveModel::Zcm1, report));
  EXPECT_TRUE(parse_psmove(PsMoveModel::Zcm2, report));
  report.resize(43);
  EXPECT_FALSE(parse_psmove(PsMoveModel::Zcm2, report));
}

TEST(PsMove, TakesItsGainsFromTheBlocksOfItsCalibrationInAnyOrder) {
  // the joined memory, and the three reports that carry it
  Report memory(143, 0);
  for (const std::size_t at : {0x2aU, 0x2cU, 0x2eU}) put16(memory, at, 0x8000 + 10);
  for (const std::size_t at : {0x46U, 0x50U, 0x5aU}) put16(memory, at, 0x8000 + 10 + 6700);
  for (const std::size_t at : {0x16U, 0x1eU, 0x08U}) put16(memory, at, 0x8000 + 4400);
  for (const std::size_t at : {0x0aU, 0x24U, 0x14U}) put16(memory, at, 0x8000 - 4300);
  std::vector<Report> blocks;
  const std::array<std::pair<std::uint8_t, std::size_t>, 3> kParts{{{0x82, 96}, {0x00, 2}, {0x01, 49}}};
  for (const auto& [number, begin] : kParts) {
    Report block{0x10, number};
    block.insert(block.end(), memory.begin() + static_cast<long>(begin),
                 memory.begin() + static_cast<long>(begin) + 47);
    blocks.push_back(block);
  }
  const PsMoveCalibration calibration = parse_psmove_calibration(PsMoveModel::Zcm1, blocks);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(6700 * calibration.gyro_gain[i], 80.0 * 2.0 * std::numbers::pi / 60.0, 1e-9);
    EXPECT_NEAR((4400 - calibration.acceleration_bias[i]) * calibration.acceleration_gain[i], 1.0, 1e-12);
  }
  blocks.pop_back();
  EXPECT_NE(parse_psmove_calibration(PsMoveModel::Zcm1, blocks).gyro_gain, calibration.gyro_gain);
}

}  // namespace sony_parsers_test
}  // namespace afm::input
