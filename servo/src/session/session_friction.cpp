// SPDX-License-Identifier: Apache-2.0
#include "servo/session_friction.h"

#include <algorithm>
#include <span>
#include <vector>

namespace afm::servo {

namespace {

using scene::TipSample;

std::vector<physics::SidewaysPoint> points_of(std::span<const TipSample> contact) {
  std::vector<physics::SidewaysPoint> points(contact.size());
  std::transform(contact.begin(), contact.end(), points.begin(), [](const TipSample& sample) {
    const auto [x, y] = sample.surface.xy_m;
    const auto [fx, fy] = sample.lateral_force_n;
    return physics::SidewaysPoint{{physics::Length(x), physics::Length(y)}, {physics::Force(fx), physics::Force(fy)}};
  });
  return points;
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
      if (const auto loop = physics::last_friction_loop(physics::along_main_line(points_of(contact)))) return loop;
    }
    end = begin;
  }
  return std::nullopt;
}

}  // namespace afm::servo
