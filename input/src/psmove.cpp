// SPDX-License-Identifier: Apache-2.0
#include "input/psmove.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "input/wand.h"

namespace afm::input {

namespace {

constexpr std::size_t kZcm1Size = 49;
constexpr std::size_t kZcm2Size = 44;
constexpr std::uint8_t kMoveCalibrationReport = 0x10;
constexpr std::size_t kBlockSize = 49;
constexpr std::size_t kBlockHeader = 2;
constexpr std::uint8_t kTriggerPressed = 100;
constexpr double kMoveCountsPerG = 4326.0;  // raw counts per g, by RPCS3's estimate
constexpr double kRadPerSPerRpm = 2.0 * std::numbers::pi / 60.0;
constexpr double kNominalGyroGain = 80.0 * kRadPerSPerRpm / 8192.0;  // within a factor of 1.5 for any device

// Number of a report; ZCM1 counts from 0x8000, ZCM2 from zero.
std::int32_t number(PsMoveModel model, Bytes bytes, std::size_t at) {
  return model == PsMoveModel::Zcm1 ? unsigned16(bytes, at) - 0x8000 : signed16(bytes, at);
}

std::array<std::int32_t, 3> triple(PsMoveModel model, Bytes bytes, std::size_t at) {
  return {number(model, bytes, at), number(model, bytes, at + 2), number(model, bytes, at + 4)};
}

// Transforms the device's axes to the wand's, which points along -z.
glm::dvec3 in_wand(const glm::dvec3& device) { return {device.x, device.z, -device.y}; }

// Joins the blocks of the calibration, each except the first without its header; empty if one is missing.
std::vector<std::uint8_t> joined(std::span<const std::uint8_t> order,
                                 std::span<const std::vector<std::uint8_t>> reports) {
  std::vector<std::uint8_t> all;
  for (const std::uint8_t number : order) {
    const auto block = std::find_if(reports.begin(), reports.end(), [&](const auto& r) {
      return r.size() >= kBlockSize && r[0] == kMoveCalibrationReport && r[1] == number;
    });
    if (block == reports.end()) return {};
    all.insert(all.end(), block->begin() + (all.empty() ? 0 : kBlockHeader), block->begin() + kBlockSize);
  }
  return all;
}

// Offsets of an axis in the calibration: readings at +1 g and -1 g, and of the gyroscope at a known speed forwards and
// at rest or backwards.
struct AxisPlaces {
  std::size_t one_g;
  std::size_t minus_one_g;
  std::size_t turned;
  std::size_t reference;
};

constexpr std::array<AxisPlaces, 3> kZcm1Places{
    {{0x16, 0x0a, 0x46, 0x2a}, {0x1e, 0x24, 0x50, 0x2c}, {0x08, 0x14, 0x5a, 0x2e}}};
constexpr std::array<AxisPlaces, 3> kZcm2Places{
    {{0x02, 0x08, 0x30, 0x42}, {0x10, 0x16, 0x38, 0x4a}, {0x1e, 0x24, 0x40, 0x52}}};
constexpr double kZcm1Rpm = 80.0;
constexpr double kZcm2Rpm = 180.0;  // change of speed from -90 to +90 rpm

class PsMove final : public HidDriver {
 public:
  explicit PsMove(PsMoveModel model) : model_(model) {}

  std::optional<HidInput> read(Bytes report) override {
    const auto parsed = parse_psmove(model_, report);
    if (!parsed) return std::nullopt;
    HidInput input;
    for (std::size_t i = 0; i < 2; ++i) {
      glm::dvec3 gyro(0.0), acceleration(0.0);
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        gyro[axis] = parsed->gyro[i][a] * calibration_.gyro_gain[a];
        acceleration[axis] =
            (parsed->acceleration[i][a] - calibration_.acceleration_bias[a]) * calibration_.acceleration_gain[a];
      }
      input.imu[i] = {.rate_rad_per_s = in_wand(gyro), .acceleration_g = in_wand(acceleration)};
    }
    input.imu_count = 2;
    input.buttons = wand_buttons(*parsed);
    return input;
  }

  std::optional<FeatureRequest> calibration() const override {
    return FeatureRequest{
        .id = kMoveCalibrationReport, .size = kBlockSize, .times = model_ == PsMoveModel::Zcm1 ? 3 : 2};
  }

  void calibrate(std::span<const std::vector<std::uint8_t>> reports) override {
    calibration_ = parse_psmove_calibration(model_, reports);
  }

 private:
  static std::uint32_t wand_buttons(const PsMoveReport& report) {
    std::uint32_t buttons = 0;
    // Move button of either reading
    if ((report.buttons[2] & 0x08) != 0 || (report.buttons[3] & 0x40) != 0) buttons |= bit(WandButton::Select);
    if (report.trigger >= kTriggerPressed) buttons |= bit(WandButton::Grab);
    if ((report.buttons[1] & 0x40) != 0) buttons |= bit(WandButton::Scale);
    if ((report.buttons[2] & 0x01) != 0) buttons |= bit(WandButton::Home);
    if ((report.buttons[0] & 0x08) != 0) buttons |= bit(WandButton::Recenter);
    return buttons;
  }

  PsMoveModel model_;
  PsMoveCalibration calibration_ = parse_psmove_calibration(model_, {});
};

}  // namespace

std::optional<PsMoveReport> parse_psmove(PsMoveModel model, Bytes report) {
  if (report.size() < (model == PsMoveModel::Zcm1 ? kZcm1Size : kZcm2Size) || report[0] != 0x01) return std::nullopt;
  return PsMoveReport{.buttons = {report[1], report[2], report[3], report[4]},
                      .trigger = std::max(report[5], report[6]),
                      .acceleration = {triple(model, report, 13), triple(model, report, 19)},
                      .gyro = {triple(model, report, 25), triple(model, report, 31)}};
}

PsMoveCalibration parse_psmove_calibration(PsMoveModel model, std::span<const std::vector<std::uint8_t>> reports) {
  PsMoveCalibration calibration;
  calibration.gyro_gain.fill(kNominalGyroGain);
  calibration.acceleration_gain.fill(1.0 / kMoveCountsPerG);

  constexpr std::array<std::uint8_t, 3> kZcm1Blocks{0x00, 0x01, 0x82};
  constexpr std::array<std::uint8_t, 2> kZcm2Blocks{0x00, 0x81};
  const bool first = model == PsMoveModel::Zcm1;
  const std::vector<std::uint8_t> all = first ? joined(kZcm1Blocks, reports) : joined(kZcm2Blocks, reports);
  if (all.empty()) return calibration;

  const double speed = (first ? kZcm1Rpm : kZcm2Rpm) * kRadPerSPerRpm;
  for (std::size_t i = 0; i < 3; ++i) {
    const AxisPlaces& at = first ? kZcm1Places[i] : kZcm2Places[i];
    const double turned = number(model, all, at.turned) - number(model, all, at.reference);
    if (turned != 0.0) calibration.gyro_gain[i] = speed / turned;
    const double up = number(model, all, at.one_g), down = number(model, all, at.minus_one_g);
    if (up == down) continue;
    calibration.acceleration_gain[i] = 2.0 / (up - down);
    calibration.acceleration_bias[i] = 0.5 * (up + down);
  }
  return calibration;
}

std::unique_ptr<HidDriver> psmove_driver(PsMoveModel model) { return std::make_unique<PsMove>(model); }

}  // namespace afm::input
