// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "render/depth_meter.h"

namespace afm::exhibit {

// Reduces the eye distance if a picture's depth would strain the eyes beyond a limit, which reduces depth equally in
// every direction. The contact point, in the wall's plane, keeps its place. One thread.
class ComfortClamp {
 public:
  // `limit_rad`: largest difference between the convergence of the eyes and that for the wall, radians.
  explicit ComfortClamp(double limit_rad) : limit_rad_(limit_rad) {}

  // Reports a measured depth, for a wall at `distance_m` and a viewer whose eyes are `ipd_m` apart.
  void measured(const render::DepthRange& range, double distance_m, double ipd_m);

  // Eye distance for drawing, instead of `ipd_m`. It narrows within a quarter of a second and widens within two, so
  // that the picture does not pulsate when an object comes and goes. Times must not decrease.
  double ipd_m(double ipd_m, std::int64_t now_ns);

  // Same after settling, for the newest measured depth.
  double settled_ipd_m(double ipd_m) const { return wanted_ * ipd_m; }

  static constexpr double kNarrowS = 0.25, kWidenS = 2.0;

 private:
  double limit_rad_;
  double wanted_ = 1.0;  // fraction of the true eye distance that the newest depth allows
  double share_ = 1.0;
  std::int64_t updated_ns_ = 0;
};

}  // namespace afm::exhibit
