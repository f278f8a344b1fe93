// SPDX-License-Identifier: Apache-2.0
#include "input/wiimote.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include "input/wand.h"

namespace afm::input {

namespace {

constexpr std::uint16_t kButtonBits = 0x9F1F;
constexpr double kRestCount = 512.0;
constexpr double kWiimoteCountsPerG = 104.0;
// the camera's field of view is 33 degrees across 1024 columns (WiiBrew)
constexpr double kRadPerColumn = 33.0 / 1024.0 * std::numbers::pi / 180.0;
constexpr double kMiddleColumn = 511.5;
constexpr double kGyroRestCount = 8192.0;
constexpr double kSlowRadPerS = 440.0 / 8192.0 * std::numbers::pi / 180.0;  // rad/s per count, in the finer range
constexpr double kFastRadPerS = 2000.0 / 8192.0 * std::numbers::pi / 180.0;
constexpr std::uint16_t kExtensionIdentifier = 0x00FA;

using Reports = std::vector<std::vector<std::uint8_t>>;

// Writes to the registers at `space`: 0xb0 is the camera, 0xa6 an inactive MotionPlus.
std::vector<std::uint8_t> write_register(std::uint8_t space, std::uint16_t address, std::vector<std::uint8_t> data) {
  std::vector<std::uint8_t> report{0x16,
                                   0x04,
                                   space,
                                   static_cast<std::uint8_t>(address >> 8),
                                   static_cast<std::uint8_t>(address),
                                   static_cast<std::uint8_t>(data.size())};
  data.resize(16);
  report.insert(report.end(), data.begin(), data.end());
  return report;
}

// Activates a MotionPlus, which then replaces the extension, reads the extension's type, and requests report 0x37
// continuously: the remote stops reporting when the extension changes. Without a MotionPlus, the remote reports a
// failed write.
Reports wake_motion_plus() {
  return {write_register(0xa6, 0x00f0, {0x55}),
          write_register(0xa6, 0x00fe, {0x04}),
          {0x17, 0x04, 0xa4, 0x00, kExtensionIdentifier, 0x00, 0x06},
          {0x12, 0x04, 0x37}};
}

// True for the identifier xx xx a4 20 xx 05; a Nunchuk's ends with 00 00, a Classic Controller's with 01 01 (WiiBrew).
bool is_motion_plus(const WiimoteReport::Memory& identifier) {
  const auto& id = identifier.bytes;
  return identifier.size == 6 && id[2] == 0xa4 && id[3] == 0x20 && id[5] == 0x05;
}

glm::dvec3 in_wand(const std::array<double, 3>& left_back_up) {
  return {-left_back_up[0], left_back_up[2], left_back_up[1]};
}

ImuSample sample_of(const std::array<std::uint16_t, 3>& acceleration, const std::optional<MotionPlusReport>& turn) {
  std::array<double, 3> pull{}, rate{};
  for (std::size_t i = 0; i < 3; ++i) {
    pull[i] = (acceleration[i] - kRestCount) / kWiimoteCountsPerG;
    if (turn) rate[i] = (turn->rates[i] - kGyroRestCount) * (turn->slow[i] ? kSlowRadPerS : kFastRadPerS);
  }
  return {.rate_rad_per_s = in_wand(rate), .acceleration_g = in_wand(pull)};
}

std::array<std::uint16_t, 3> acceleration_of(Bytes r) {
  const auto ten_bits = [](unsigned high, unsigned low) { return static_cast<std::uint16_t>((high << 2) | low); };
  return {ten_bits(r[3], (r[1] >> 5) & 3U), ten_bits(r[4], (r[2] >> 4) & 2U), ten_bits(r[5], (r[2] >> 5) & 2U)};
}

// Dot from two high bits of each coordinate, y above x; all ones means no dot.
std::optional<WiimoteReport::Dot> dot_of(unsigned x_low, unsigned y_low, unsigned high) {
  const auto x = static_cast<std::uint16_t>(x_low | ((high & 3U) << 8));
  const auto y = static_cast<std::uint16_t>(y_low | ((high & 12U) << 6));
  if (x >= 1023 || y >= 768) return std::nullopt;
  return WiimoteReport::Dot{x, y};
}

std::array<std::uint8_t, 6> extension_at(Bytes report, std::size_t at) {
  std::array<std::uint8_t, 6> bytes;
  std::copy_n(report.begin() + static_cast<std::ptrdiff_t>(at), bytes.size(), bytes.begin());
  return bytes;
}

// Byte 3: size minus one in its upper half, an error in its lower one; then the address, high byte first.
WiimoteReport::Memory memory_of(Bytes report) {
  WiimoteReport::Memory memory;
  memory.address = static_cast<std::uint16_t>((report[4] << 8) | report[5]);
  memory.size = (report[3] & 0x0F) == 0 ? (report[3] >> 4) + std::size_t{1} : 0;
  std::copy_n(report.begin() + 6, memory.bytes.size(), memory.bytes.begin());
  return memory;
}

class Wiimote final : public HidDriver {
 public:
  std::optional<HidInput> read(Bytes report) override {
    const auto parsed = parse_wiimote(report);
    if (!parsed) return std::nullopt;
    HidInput input;
    input.buttons = wand_buttons(parsed->buttons);
    const auto held = [&](unsigned mask) { return (parsed->buttons & mask) != 0 ? 1.0 : 0.0; };
    input.push = glm::dvec3(held(0x0002) - held(0x0001), 0.0, held(0x0004) - held(0x0008));
    follow_extension(*parsed);
    const bool has_gyro = motion_plus_ && parsed->extension;
    const auto turn = has_gyro ? parse_motion_plus(*parsed->extension) : std::nullopt;
    // reports from behind a MotionPlus contain no rotation since the previous report
    if (parsed->acceleration && turn.has_value() == has_gyro) {
      input.imu[0] = sample_of(*parsed->acceleration, turn);
      input.imu_count = 1;
      input.has_gyro = has_gyro;
    }
    double sum = 0.0;
    int seen = 0;
    for (const auto& dot : parsed->dots) {
      if (!dot) continue;
      sum += dot->x;
      ++seen;
    }
    if (seen > 0) input.yaw_from_forward_rad = (sum / seen - kMiddleColumn) * kRadPerColumn;
    return input;
  }

  // Switches the camera on, in the order given by WiiBrew, with the dot format of report 0x37.
  Reports set_up() const override {
    Reports reports{
        {0x11, 0x10},
        {0x13, 0x04},
        {0x1a, 0x04},
        write_register(0xb0, 0x30, {0x08}),
        write_register(0xb0, 0x00, {0x02, 0x00, 0x00, 0x71, 0x01, 0x00, 0xaa, 0x00, 0x64}),
        write_register(0xb0, 0x1a, {0x63, 0x03}),
        write_register(0xb0, 0x33, {0x01}),
        write_register(0xb0, 0x30, {0x08}),
    };
    for (auto& report : wake_motion_plus()) reports.push_back(std::move(report));
    return reports;
  }

  Reports take_answers() override { return std::exchange(answers_, {}); }

 private:
  // An activated MotionPlus counts as a change of extension. Once active, it ignores activation, which ends the
  // sequence.
  void follow_extension(const WiimoteReport& report) {
    if (report.plug_changed) {
      motion_plus_ = false;
      answers_ = wake_motion_plus();
    } else if (report.memory && report.memory->address == kExtensionIdentifier) {
      motion_plus_ = is_motion_plus(*report.memory);
    }
  }

  static std::uint32_t wand_buttons(std::uint16_t raw) {
    std::uint32_t buttons = 0;
    if ((raw & 0x0800) != 0) buttons |= bit(WandButton::Select);
    if ((raw & 0x0400) != 0) buttons |= bit(WandButton::Grab);
    if ((raw & 0x0010) != 0) buttons |= bit(WandButton::Scale);
    if ((raw & 0x8000) != 0) buttons |= bit(WandButton::Home);
    if ((raw & 0x1000) != 0) buttons |= bit(WandButton::Recenter);
    return buttons;
  }

  bool motion_plus_ = false;  // true: a MotionPlus is active
  Reports answers_;
};

}  // namespace

std::optional<WiimoteReport> parse_wiimote(Bytes report) {
  if (report.size() < 3) return std::nullopt;
  WiimoteReport parsed;
  parsed.buttons = unsigned16(report, 1) & kButtonBits;
  switch (report[0]) {
    case 0x20:
      if (report.size() < 7) return std::nullopt;
      parsed.plug_changed = true;
      return parsed;
    case 0x21:
      if (report.size() < 22) return std::nullopt;
      parsed.memory = memory_of(report);
      return parsed;
    case 0x30:
      return parsed;
    case 0x31:
      if (report.size() < 6) return std::nullopt;
      break;
    case 0x33:
      if (report.size() < 18) return std::nullopt;
      for (std::size_t i = 0; i < 4; ++i) {
        const Bytes dot = report.subspan(6 + 3 * i, 3);
        parsed.dots[i] = dot_of(dot[0], dot[1], dot[2] >> 4);
      }
      break;
    case 0x35:
      if (report.size() < 22) return std::nullopt;
      parsed.extension = extension_at(report, 6);
      break;
    case 0x37:
      if (report.size() < 22) return std::nullopt;
      for (std::size_t i = 0; i < 2; ++i) {
        const Bytes pair = report.subspan(6 + 5 * i, 5);
        parsed.dots[2 * i] = dot_of(pair[0], pair[1], pair[2] >> 4);
        parsed.dots[2 * i + 1] = dot_of(pair[3], pair[4], pair[2] & 15U);
      }
      parsed.extension = extension_at(report, 16);
      break;
    default:
      return std::nullopt;
  }
  parsed.acceleration = acceleration_of(report);
  return parsed;
}

std::optional<MotionPlusReport> parse_motion_plus(Bytes e) {
  if (e.size() < 6 || (e[5] & 3U) != 2U) return std::nullopt;
  const auto rate = [&](std::size_t axis) {
    return static_cast<std::uint16_t>(e[axis] | ((e[axis + 3] & 0xFCU) << 6));
  };
  // rates in the order yaw, roll, pitch
  return MotionPlusReport{.rates = {rate(2), rate(1), rate(0)},
                          .slow = {(e[3] & 1U) != 0, (e[4] & 2U) != 0, (e[3] & 2U) != 0}};
}

std::unique_ptr<HidDriver> wiimote_driver() { return std::make_unique<Wiimote>(); }

}  // namespace afm::input
