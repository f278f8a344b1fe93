// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace afm::physics {

// Direction of a rod on the sample: half its angle from the x axis about the vertical, as the parts w and z of a unit
// quaternion. A tick turns it without computing a sine.
struct HalfTurn {
  double w = 1.0, z = 0.0;

  bool operator==(const HalfTurn&) const = default;
};

inline HalfTurn half_turn(double angle_rad) noexcept { return {std::cos(0.5 * angle_rad), std::sin(0.5 * angle_rad)}; }
inline double angle_rad(const HalfTurn& turn) noexcept { return 2.0 * std::atan2(turn.z, turn.w); }

}  // namespace afm::physics
