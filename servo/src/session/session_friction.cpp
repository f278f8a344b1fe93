// SPDX-License-Identifier: Apache-2.0
#include "servo/session_friction.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace afm::servo {

namespace {

using scene::TipSample;

// Along the line of the largest spread, from one end of its places to the other.
std::vector<physics::LateralPoint> along_main_line(std::span<const TipSample> contact) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  for (const TipSample& sample : contact) {
    const auto [sx, sy] = sample.surface.xy_m;
    n += 1.0;
    x += sx;
    y += sy;
    xx += sx * sx;
    xy += sx * sy;
    yy += sy * sy;
  }
  const double angle = 0.5 * std::atan2(2.0 * (xy - x * y / n), xx - x * x / n - yy + y * y / n);
  const double ux = std::cos(angle), uy = std::sin(angle);
  std::vector<physics::LateralPoint> run(contact.size());
  std::transform(contact.begin(), contact.end(), run.begin(), [&](const TipSample& sample) {
    const auto [sx, sy] = sample.surface.xy_m;
    const auto [fx, fy] = sample.lateral_force_n;
    return physics::LateralPoint{physics::Length(ux * sx + uy * sy), physics::Force(-ux * fx - uy * fy)};
  });
  return run;
}

}  // namespace

std::optional<physics::FrictionLoop> friction_loop(const RecordedSession& session) {
  const auto touches = [](const TipSample& sample) { return sample.phase == physics::Phase::Attached; };
  auto end = session.samples.rbegin();
  while (end != session.samples.rend()) {
    end = std::find_if(end, session.samples.rend(), touches);
    const auto begin = std::find_if_not(end, session.samples.rend(), touches);
    const std::span<const TipSample> contact(begin.base(), end.base());
    if (!contact.empty()) {
      if (const auto loop = physics::last_friction_loop(along_main_line(contact))) return loop;
    }
    end = begin;
  }
  return std::nullopt;
}

}  // namespace afm::servo
