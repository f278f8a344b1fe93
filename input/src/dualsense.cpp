// SPDX-License-Identifier: Apache-2.0
#include "input/dualsense.h"

#include <cmath>

#include "input/wand.h"

namespace afm::input {

namespace {

constexpr std::uint8_t kUsbReport = 0x01;
constexpr std::size_t kUsbSize = 64;
constexpr std::uint8_t kBluetoothReport = 0x31;
constexpr std::size_t kBluetoothSize = 78;
constexpr std::uint8_t kInputSeed = 0xA1;
constexpr std::uint8_t kCalibrationReport = 0x05;
constexpr std::size_t kCalibrationSize = 41;
constexpr double kNominalGyroCountsPerDegree = 16.0;  // 2048 degrees per second in 15 bits
constexpr double kNominalCountsPerG = 8192.0;

double stick(std::uint8_t raw) { return std::fmax(-1.0, (raw - 128.0) / 127.0); }

class DualSense final : public HidDriver {
 public:
  std::optional<HidInput> read(Bytes report) override {
    const auto parsed = parse_dualsense(report);
    if (!parsed) return std::nullopt;
    HidInput input;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      input.imu[0].rate_rad_per_s[axis] = (parsed->gyro[i] - calibration_.gyro_bias[i]) * calibration_.gyro_gain[i];
      input.imu[0].acceleration_g[axis] =
          (parsed->acceleration[i] - calibration_.acceleration_bias[i]) * calibration_.acceleration_gain[i];
    }
    input.imu_count = 1;
    input.push = glm::dvec3(stick(parsed->left_stick[0]), -stick(parsed->right_stick[1]), stick(parsed->left_stick[1]));
    input.turn = glm::dvec3(0.0, stick(parsed->right_stick[0]), 0.0);
    input.buttons = wand_buttons(parsed->buttons);
    return input;
  }

  std::optional<FeatureRequest> calibration() const override {
    return FeatureRequest{.id = kCalibrationReport, .size = kCalibrationSize};
  }

  void calibrate(std::span<const std::vector<std::uint8_t>> reports) override {
    if (!reports.empty()) calibration_ = parse_dualsense_calibration(reports.front());
  }

 private:
  static std::uint32_t wand_buttons(const std::array<std::uint8_t, 3>& raw) {
    std::uint32_t buttons = 0;
    if ((raw[0] & 0x20) != 0) buttons |= bit(WandButton::Select);
    if ((raw[1] & 0x08) != 0) buttons |= bit(WandButton::Grab);
    if ((raw[1] & 0x04) != 0) buttons |= bit(WandButton::Scale);
    if ((raw[2] & 0x01) != 0) buttons |= bit(WandButton::Home);
    if ((raw[1] & 0x20) != 0) buttons |= bit(WandButton::Recenter);
    return buttons;
  }

  DualSenseCalibration calibration_ = parse_dualsense_calibration({});
};

}  // namespace

std::uint32_t sony_crc32(std::uint8_t seed, Bytes bytes) {
  std::uint32_t crc = 0xFFFFFFFFU;
  const auto add = [&crc](std::uint8_t byte) {
    crc ^= byte;
    for (int i = 0; i < 8; ++i) crc = (crc >> 1) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  };
  add(seed);
  for (const std::uint8_t byte : bytes) add(byte);
  return ~crc;
}

std::optional<DualSenseReport> parse_dualsense(Bytes report) {
  if (report.empty()) return std::nullopt;
  Bytes r;  // bytes as over USB
  if (report[0] == kUsbReport && report.size() == kUsbSize) {
    r = report;
  } else if (report[0] == kBluetoothReport && report.size() == kBluetoothSize) {
    if (sony_crc32(kInputSeed, report.first(kBluetoothSize - 4)) != unsigned32(report, kBluetoothSize - 4)) {
      return std::nullopt;
    }
    r = report.subspan(1);
  } else {
    return std::nullopt;
  }
  return DualSenseReport{.left_stick = {r[1], r[2]},
                         .right_stick = {r[3], r[4]},
                         .triggers = {r[5], r[6]},
                         .sequence = r[7],
                         .buttons = {r[8], r[9], r[10]},
                         .gyro = signed16_triple(r, 16),
                         .acceleration = signed16_triple(r, 22),
                         .ticks = unsigned32(r, 28)};
}

DualSenseCalibration parse_dualsense_calibration(Bytes report) {
  DualSenseCalibration calibration;
  calibration.gyro_gain.fill(kRadPerDegree / kNominalGyroCountsPerDegree);
  calibration.acceleration_gain.fill(1.0 / kNominalCountsPerG);
  if (report.size() < kCalibrationSize || report[0] != kCalibrationReport) return calibration;

  const double turned_deg_per_s = signed16(report, 19) + signed16(report, 21);
  for (std::size_t i = 0; i < 3; ++i) {
    const double span = signed16(report, 7 + 4 * i) - signed16(report, 9 + 4 * i);
    const double gain = turned_deg_per_s / span * kRadPerDegree;
    if (std::isnormal(gain)) {
      calibration.gyro_gain[i] = gain;
      calibration.gyro_bias[i] = signed16(report, 1 + 2 * i);
    }
    const double plus = signed16(report, 23 + 4 * i), minus = signed16(report, 25 + 4 * i);
    if (plus != minus) {
      calibration.acceleration_gain[i] = 2.0 / (plus - minus);
      calibration.acceleration_bias[i] = 0.5 * (plus + minus);
    }
  }
  return calibration;
}

std::unique_ptr<HidDriver> dualsense_driver() { return std::make_unique<DualSense>(); }

}  // namespace afm::input
