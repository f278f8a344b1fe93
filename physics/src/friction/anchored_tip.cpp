// SPDX-License-Identifier: Apache-2.0
#include "physics/friction/anchored_tip.h"

#include <algorithm>
#include <cmath>

namespace afm::physics {

void AnchoredTip::land(const Sideways<Length>& support) noexcept {
  support_ = support;
  x_ = y_ = 0.0;
}

Energy AnchoredTip::move_to(const Sideways<Length>& support, Force yield) noexcept {
  const double dx = support.x.si - support_.x.si, dy = support.y.si - support_.y.si;
  support_ = support;
  const double reach = yield.si / k_;
  double lost = 0.0;
  if (const double length = std::hypot(x_, y_); length > reach) {
    x_ *= reach / length;
    y_ *= reach / length;
    lost = 0.5 * k_ * (length * length - reach * reach);
  }
  const double way = std::hypot(dx, dy);
  if (!(way > 0.0)) return Energy(lost);

  // along the path and across it, up to where it leaves the circle within which the anchor holds
  const double ux = dx / way, uy = dy / way;
  const double along = x_ * ux + y_ * uy, across = y_ * ux - x_ * uy;
  const double edge = std::sqrt(std::max(0.0, reach * reach - across * across));
  const double held = std::clamp(edge - along, 0.0, way);
  double end_along = along + held, end_across = across;
  if (const double dragged = way - held; dragged > 0.0) {
    // the tractrix: tangent of half the angle between L and the path
    const double half_before = reach > 0.0 ? end_across / (reach + end_along) : 0.0;
    const double half = reach > 0.0 ? half_before * std::exp(-dragged / reach) : 0.0;
    const double scale = reach / (1.0 + half * half);
    end_along = scale * (1.0 - half * half);
    end_across = scale * 2.0 * half;
    // k r times the anchor's path, the integral of the cosine of the angle
    const double turning = std::log1p(half * half) - std::log1p(half_before * half_before);
    lost += k_ * reach * std::max(0.0, dragged + reach * turning);
  }
  x_ = end_along * ux - end_across * uy;
  y_ = end_along * uy + end_across * ux;
  return Energy(lost);
}

}  // namespace afm::physics
