// SPDX-License-Identifier: Apache-2.0
#include "input/joycon.h"

#include <algorithm>
#include <cmath>

#include "input/wand.h"

namespace afm::input {

namespace {

constexpr std::uint8_t kFullReport = 0x30;
constexpr std::size_t kFullSize = 49;
constexpr std::size_t kMotionSize = 12;
constexpr double kJoyConCountsPerG = 4096.0;
constexpr double kCountsPerDegree = 14.247;
constexpr double kRadPerCount = kRadPerDegree / kCountsPerDegree;
constexpr double kStickMiddle = 2048.0;
constexpr double kStickReach = 1400.0;

std::array<std::uint16_t, 2> stick_at(Bytes r, std::size_t at) {
  return {static_cast<std::uint16_t>(r[at] | ((r[at + 1] & 0x0F) << 8)),
          static_cast<std::uint16_t>((r[at + 1] >> 4) | (r[at + 2] << 4))};
}

double pushed(std::uint16_t raw) { return std::clamp((raw - kStickMiddle) / kStickReach, -1.0, 1.0); }

struct ButtonPlace {
  std::size_t byte;
  std::uint8_t mask;
  WandButton button;
};

constexpr std::array<ButtonPlace, 5> kRightButtons{{{0, 0x08, WandButton::Select},
                                                    {0, 0x80, WandButton::Grab},
                                                    {0, 0x40, WandButton::Scale},
                                                    {1, 0x10, WandButton::Home},
                                                    {1, 0x02, WandButton::Recenter}}};
constexpr std::array<ButtonPlace, 5> kLeftButtons{{{2, 0x04, WandButton::Select},
                                                   {2, 0x80, WandButton::Grab},
                                                   {2, 0x40, WandButton::Scale},
                                                   {1, 0x20, WandButton::Home},
                                                   {1, 0x01, WandButton::Recenter}}};

class JoyCon final : public HidDriver {
 public:
  explicit JoyCon(JoyConSide side) : side_(side) {}

  std::optional<HidInput> read(Bytes report) override {
    const auto parsed = parse_joycon(report);
    if (!parsed) return std::nullopt;
    HidInput input;
    for (std::size_t i = 0; i < parsed->motion.size(); ++i) {
      input.imu[i].rate_rad_per_s = kRadPerCount * in_wand(parsed->motion[i].gyro);
      input.imu[i].acceleration_g = in_wand(parsed->motion[i].acceleration) / kJoyConCountsPerG;
    }
    input.imu_count = parsed->motion.size();
    const auto& stick = parsed->sticks[side_ == JoyConSide::Right ? 1 : 0];
    input.push = glm::dvec3(pushed(stick[0]), 0.0, -pushed(stick[1]));
    std::uint32_t buttons = 0;
    for (const ButtonPlace& place : side_ == JoyConSide::Left ? kLeftButtons : kRightButtons) {
      if ((parsed->buttons[place.byte] & place.mask) != 0) buttons |= bit(place.button);
    }
    input.buttons = buttons;
    return input;
  }

  // Subcommands 0x03 (full reports) and 0x40 (motion sensor on), each after the neutral rumble of both motors.
  std::vector<std::vector<std::uint8_t>> set_up() const override {
    const auto subcommand = [](std::uint8_t count, std::uint8_t command, std::uint8_t argument) {
      return std::vector<std::uint8_t>{0x01, count, 0x00, 0x01, 0x40, 0x40, 0x00, 0x01, 0x40, 0x40, command, argument};
    };
    return {subcommand(0, 0x03, 0x30), subcommand(1, 0x40, 0x01)};
  }

 private:
  // The sensor of a right Joy-Con is rotated by 180 degrees about the pointing axis relative to a left one.
  glm::dvec3 in_wand(const std::array<std::int16_t, 3>& raw) const {
    const double flip = side_ == JoyConSide::Right ? -1.0 : 1.0;
    return {-flip * raw[1], flip * raw[2], -raw[0]};
  }

  JoyConSide side_;
};

}  // namespace

std::optional<JoyConReport> parse_joycon(Bytes report) {
  if (report.size() < kFullSize || report[0] != kFullReport) return std::nullopt;
  JoyConReport parsed;
  parsed.buttons = {report[3], report[4], report[5]};
  parsed.sticks = {stick_at(report, 6), stick_at(report, 9)};
  for (std::size_t i = 0; i < parsed.motion.size(); ++i) {
    parsed.motion[i].acceleration = signed16_triple(report, 13 + kMotionSize * i);
    parsed.motion[i].gyro = signed16_triple(report, 19 + kMotionSize * i);
  }
  return parsed;
}

std::unique_ptr<HidDriver> joycon_driver(JoyConSide side) { return std::make_unique<JoyCon>(side); }

}  // namespace afm::input
