// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/hand_script.h"

#include <algorithm>
#include <cmath>

namespace afm::scene {

using physics::LeverBase;

std::size_t ticks_of(const LeverBase& from, const HandMove& move, physics::Frequency rate) {
  const double way = std::hypot((move.to.position.x - from.position.x).si, (move.to.position.y - from.position.y).si,
                                (move.to.z - from.z).si);
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(way / move.speed.si * rate.si)));
}

std::size_t waiting_ticks(const HandMove& move, physics::Frequency rate) {
  return static_cast<std::size_t>(std::ceil(move.wait.si * rate.si));
}

double all_ticks(const ParticleSet& set, physics::Frequency rate) {
  double ticks = 0.0;
  LeverBase from = set.start;
  for (const HandMove& move : set.moves) {
    ticks += static_cast<double>(ticks_of(from, move, rate) + waiting_ticks(move, rate));
    from = move.to;
  }
  return ticks;
}

LeverBase on_the_way(const LeverBase& a, const LeverBase& b, double share) {
  return {a.position + (b.position - a.position) * share, a.z + (b.z - a.z) * share};
}

}  // namespace afm::scene
