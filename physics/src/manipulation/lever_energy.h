// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "physics/manipulation/push_figures.h"

namespace afm::physics {

struct Apex {
  double x = 0.0, y = 0.0, height = 0.0;  // position, metres
};

// Energy of a lever whose base is away from the apex.
inline double lever_j(const PushSprings& springs, const Apex& base, const Apex& apex) noexcept {
  const double x = apex.x - base.x, y = apex.y - base.y, z = apex.height - base.height;
  return 0.5 * (springs.lateral.si * (x * x + y * y) + springs.normal.si * z * z);
}

// Work on the base by the mean of the forces on the lever before and after.
inline double work_j(const PushSprings& springs, const Apex& base0, const Apex& apex0, const Apex& base1,
                     const Apex& apex1) noexcept {
  const double x = 0.5 * ((base0.x - apex0.x) + (base1.x - apex1.x)) * (base1.x - base0.x);
  const double y = 0.5 * ((base0.y - apex0.y) + (base1.y - apex1.y)) * (base1.y - base0.y);
  const double z =
      0.5 * ((base0.height - apex0.height) + (base1.height - apex1.height)) * (base1.height - base0.height);
  return springs.lateral.si * (x + y) + springs.normal.si * z;
}

inline bool is_within(double reach_m, const Apex& a, const Apex& b) noexcept {
  const double x = a.x - b.x, y = a.y - b.y, z = a.height - b.height;
  return x * x + y * y + z * z <= reach_m * reach_m;
}

}  // namespace afm::physics
