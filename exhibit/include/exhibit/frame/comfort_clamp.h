// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "render/depth_meter.h"

namespace afm::exhibit {

// Draws for eyes that are less far apart wherever the depth of a picture would ask more of a viewer than a limit: less
// depth, in every direction alike. The contact point, in the wall's plane, stays where it is. One thread.
class ComfortClamp {
 public:
  // Of the angle that the eyes turn in more, or less, than for the wall.
  explicit ComfortClamp(double limit_rad) : limit_rad_(limit_rad) {}

  // A depth that was measured, before a wall at `distance_m`, for eyes that are truly `ipd_m` apart.
  void measured(const render::DepthRange& range, double distance_m, double ipd_m);

  // The eye distance to draw for, instead of `ipd_m`. It narrows within a quarter of a second and widens within two, so
  // that a thing that comes and goes does not make the picture breathe. Times never run backwards.
  double ipd_m(double ipd_m, std::int64_t now_ns);

  // The same once it has settled: what the depth measured last is about to be drawn for.
  double settled_ipd_m(double ipd_m) const { return wanted_ * ipd_m; }

  static constexpr double kNarrowS = 0.25, kWidenS = 2.0;

 private:
  double limit_rad_;
  double wanted_ = 1.0;  // share of the true eye distance
  double share_ = 1.0;
  std::int64_t updated_ns_ = 0;
};

}  // namespace afm::exhibit
