// SPDX-License-Identifier: Apache-2.0
#include "exhibit/frame/comfort_clamp.h"

#include <algorithm>
#include <cmath>

#include "core/clock.h"
#include "scene/display/disparity.h"

namespace afm::exhibit {

void ComfortClamp::measured(const render::DepthRange& range, double distance_m, double ipd_m) {
  const auto angle = [&](double depth_m) {
    return std::abs(scene::disparity_at(distance_m, ipd_m, depth_m).crossed_rad);
  };
  // for eyes some centimetres apart, the angle is proportional to their distance within one percent
  constexpr double kProportional = 0.99;
  const double most = std::max(angle(range.nearest_m), angle(range.farthest_m));
  wanted_ = most > limit_rad_ ? kProportional * limit_rad_ / most : 1.0;
}

double ComfortClamp::ipd_m(double ipd_m, std::int64_t now_ns) {
  const double step_s = updated_ns_ == 0 ? 0.0 : std::max(0.0, core::seconds(now_ns - updated_ns_));
  updated_ns_ = now_ns;
  const double fastest = step_s / (wanted_ < share_ ? kNarrowS : kWidenS);
  share_ += std::clamp(wanted_ - share_, -fastest, fastest);
  return share_ * ipd_m;
}

}  // namespace afm::exhibit
