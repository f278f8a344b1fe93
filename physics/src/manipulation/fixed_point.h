// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace afm::physics {

// The x >= 0 with x = map(x), for a map that is positive, does not fall and is concave, so that there is at most one.
// Infinity if there is none below `largest`.
template <class Map>
double least_fixed_point(const Map& map, double largest) {
  constexpr int kMostSteps = 100;
  constexpr double kRelative = 1e-15;
  double before = 0.0, value = map(0.0);
  double gap_before = value;
  for (int i = 0; i < kMostSteps; ++i) {
    if (!(value >= 0.0 && value < largest)) break;
    const double next = map(value);
    const double gap = next - value;
    if (std::abs(gap) <= kRelative * value) return value;
    // the secant of map(x) - x, where that falls
    const double slope = (gap - gap_before) / (value - before);
    const double step = slope < 0.0 ? -gap / slope : gap;
    before = value;
    gap_before = gap;
    value = value + step > 0.0 ? value + step : next;
    if (value == before) return value;
  }
  return value < largest && value >= 0.0 ? value : HUGE_VAL;
}

}  // namespace afm::physics
