// SPDX-License-Identifier: Apache-2.0
#include "input/hid_mapping.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace afm::input {

namespace {

std::optional<double> raw_value(const HidMapping::Axis& axis, Bytes report) {
  const std::size_t last = axis.byte + (axis.bit + axis.bits - 1) / 8;
  if (last >= report.size()) return std::nullopt;
  std::uint64_t value = 0;
  for (std::size_t i = last + 1; i-- > axis.byte;) value = (value << 8) | report[i];
  value = (value >> axis.bit) & ((std::uint64_t{1} << axis.bits) - 1);
  const auto magnitude = static_cast<double>(value);
  const bool negative = axis.is_signed && ((value >> (axis.bits - 1)) & 1U) != 0;
  return negative ? magnitude - std::ldexp(1.0, static_cast<int>(axis.bits)) : magnitude;
}

// 0 within the dead zone, then linear up to full deflection.
double deflection(double share, double dead_zone) {
  const double beyond = std::max(0.0, std::abs(share) - dead_zone) / (1.0 - dead_zone);
  return std::copysign(std::min(1.0, beyond), share);
}

class MappedWand final : public HidDriver {
 public:
  explicit MappedWand(const HidMapping& mapping) : mapping_(mapping) {}

  std::optional<HidInput> read(Bytes report) override {
    HidInput input;
    bool known = false;
    for (const HidMapping::Axis& axis : mapping_.axes) {
      if (!is_of(axis.report, report)) continue;
      const auto raw = raw_value(axis, report);
      if (!raw) return std::nullopt;
      known = true;
      take(axis, (*raw - axis.center) / axis.scale, input);
    }
    for (const HidMapping::Button& button : mapping_.buttons) {
      if (!is_of(button.report, report)) continue;
      if (button.byte >= report.size()) return std::nullopt;
      known = true;
      const std::uint32_t mask = bit(button.button);
      const bool down = ((report[button.byte] >> button.bit) & 1) != 0;
      buttons_ = down ? buttons_ | mask : buttons_ & ~mask;
      input.buttons = buttons_;
    }
    if (!known) return std::nullopt;
    return input;
  }

  bool steered() const override {
    if (mapping_.axes.empty()) return false;  // no direction of a pedal
    return std::none_of(mapping_.axes.begin(), mapping_.axes.end(), [](const HidMapping::Axis& axis) {
      return axis.quantity == HidMapping::Quantity::Gyro || axis.quantity == HidMapping::Quantity::Acceleration;
    });
  }

 private:
  static bool is_of(std::uint8_t number, Bytes report) {
    return number == 0 || (!report.empty() && report[0] == number);
  }

  void take(const HidMapping::Axis& axis, double value, HidInput& input) {
    switch (axis.quantity) {
      case HidMapping::Quantity::Push:
        push_[axis.axis] = deflection(value, axis.dead_zone);
        input.push = push_;
        return;
      case HidMapping::Quantity::Turn:
        turn_[axis.axis] = deflection(value, axis.dead_zone);
        input.turn = turn_;
        return;
      case HidMapping::Quantity::Gyro:
        imu_.rate_rad_per_s[axis.axis] = value * kRadPerDegree;
        break;
      case HidMapping::Quantity::Acceleration:
        imu_.acceleration_g[axis.axis] = value;
        break;
    }
    input.imu[0] = imu_;
    input.imu_count = 1;
    input.has_gyro = has_gyro();
  }

  bool has_gyro() const {
    return std::any_of(mapping_.axes.begin(), mapping_.axes.end(),
                       [](const HidMapping::Axis& axis) { return axis.quantity == HidMapping::Quantity::Gyro; });
  }

  HidMapping mapping_;
  glm::dvec3 push_{0.0};
  glm::dvec3 turn_{0.0};
  ImuSample imu_;
  std::uint32_t buttons_ = 0;
};

}  // namespace

std::unique_ptr<HidDriver> mapped_driver(const HidMapping& mapping) { return std::make_unique<MappedWand>(mapping); }

}  // namespace afm::input
