// SPDX-License-Identifier: Apache-2.0
#include "input/wiimote.h"

#include <algorithm>
#include <numbers>

#include "input/wand.h"

namespace afm::input {

namespace {

constexpr std::uint16_t kButtonBits = 0x9F1F;
constexpr double kRestCount = 512.0;
constexpr double kCountsPerG = 104.0;
// the camera sees 33 degrees across its 1024 columns (WiiBrew)
constexpr double kRadPerColumn = 33.0 / 1024.0 * std::numbers::pi / 180.0;
constexpr double kMiddleColumn = 511.5;

std::array<std::uint16_t, 3> acceleration_of(Bytes r) {
  const auto ten_bits = [](unsigned high, unsigned low) { return static_cast<std::uint16_t>((high << 2) | low); };
  return {ten_bits(r[3], (r[1] >> 5) & 3U), ten_bits(r[4], (r[2] >> 4) & 2U), ten_bits(r[5], (r[2] >> 5) & 2U)};
}

// Two high bits of each coordinate, y above x; all ones is no dot.
std::optional<WiimoteReport::Dot> dot_of(unsigned x_low, unsigned y_low, unsigned high) {
  const auto x = static_cast<std::uint16_t>(x_low | ((high & 3U) << 8));
  const auto y = static_cast<std::uint16_t>(y_low | ((high & 12U) << 6));
  if (x >= 1023 || y >= 768) return std::nullopt;
  return WiimoteReport::Dot{x, y};
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
    if (parsed->acceleration) {
      const auto g = [&](std::size_t i) { return ((*parsed->acceleration)[i] - kRestCount) / kCountsPerG; };
      input.imu[0].acceleration_g = {-g(0), g(2), g(1)};
      input.imu_count = 1;
      input.has_gyro = false;
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

  // Switches the camera on, in the order of WiiBrew, and asks for report 0x33 all the time.
  std::vector<std::vector<std::uint8_t>> set_up() const override {
    const auto write = [](std::uint16_t address, std::vector<std::uint8_t> data) {
      std::vector<std::uint8_t> report{0x16,
                                       0x04,
                                       0xb0,
                                       static_cast<std::uint8_t>(address >> 8),
                                       static_cast<std::uint8_t>(address),
                                       static_cast<std::uint8_t>(data.size())};
      data.resize(16);
      report.insert(report.end(), data.begin(), data.end());
      return report;
    };
    return {{0x11, 0x10},
            {0x13, 0x04},
            {0x1a, 0x04},
            write(0x30, {0x08}),
            write(0x00, {0x02, 0x00, 0x00, 0x71, 0x01, 0x00, 0xaa, 0x00, 0x64}),
            write(0x1a, {0x63, 0x03}),
            write(0x33, {0x03}),
            write(0x30, {0x08}),
            {0x12, 0x04, 0x33}};
  }

 private:
  static std::uint32_t wand_buttons(std::uint16_t raw) {
    std::uint32_t buttons = 0;
    if ((raw & 0x0800) != 0) buttons |= bit(WandButton::Select);
    if ((raw & 0x0400) != 0) buttons |= bit(WandButton::Grab);
    if ((raw & 0x0010) != 0) buttons |= bit(WandButton::Scale);
    if ((raw & 0x8000) != 0) buttons |= bit(WandButton::Home);
    if ((raw & 0x1000) != 0) buttons |= bit(WandButton::Recenter);
    return buttons;
  }
};

}  // namespace

std::optional<WiimoteReport> parse_wiimote(Bytes report) {
  if (report.size() < 3) return std::nullopt;
  WiimoteReport parsed;
  parsed.buttons = unsigned16(report, 1) & kButtonBits;
  switch (report[0]) {
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
    case 0x37:
      if (report.size() < 22) return std::nullopt;
      for (std::size_t i = 0; i < 2; ++i) {
        const Bytes pair = report.subspan(6 + 5 * i, 5);
        parsed.dots[2 * i] = dot_of(pair[0], pair[1], pair[2] >> 4);
        parsed.dots[2 * i + 1] = dot_of(pair[3], pair[4], pair[2] & 15U);
      }
      break;
    default:
      return std::nullopt;
  }
  parsed.acceleration = acceleration_of(report);
  return parsed;
}

std::unique_ptr<HidDriver> wiimote_driver() { return std::make_unique<Wiimote>(); }

}  // namespace afm::input
