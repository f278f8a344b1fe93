// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/sample_drift.h"

#include <cmath>
#include <numbers>

#include "physics/manipulation/tip_hold.h"

namespace afm::physics {

SampleDrift::SampleDrift(Velocity rate, std::uint64_t seed) noexcept {
  const double angle = 2.0 * std::numbers::pi * scatter_number(seed, 0, 0);
  velocity_ = {rate * std::cos(angle), rate * std::sin(angle)};
}

Sideways<Length> SampleDrift::after(Time elapsed) const noexcept {
  return {velocity_.x * elapsed, velocity_.y * elapsed};
}

Length PlaceDoubt::after(Time age) const noexcept { return Length(std::hypot(at_first.si, (rate * age).si)); }

Time PlaceDoubt::stale_after(Length radius) const noexcept {
  const Length most = 0.5 * radius;
  if (!(at_first < most)) return Time(0.0);
  if (!(rate.si > 0.0)) return Time(HUGE_VAL);
  return sqrt((most - at_first) * (most + at_first)) / rate;
}

Time scan_time(std::size_t lines, Frequency line_rate) noexcept {
  return Time(static_cast<double>(lines) / line_rate.si);
}

}  // namespace afm::physics
