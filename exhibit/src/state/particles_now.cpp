// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/particles_now.h"

#include <vector>

#include "scene/samples/pattern_state.h"

namespace afm::exhibit {

std::optional<scene::PatternState> pattern_of(const ParticlesNow& now) {
  using Place = physics::Sideways<physics::Length>;
  const scene::ParticleSet& set = *now.set;
  if (set.targets.empty()) return std::nullopt;
  std::vector<Place> places;
  for (std::size_t i = 0; i < set.particles.size(); ++i) {
    const auto pose = pose_of(now, i);
    if (!pose) return std::nullopt;
    places.push_back({physics::Length(pose->x_m), physics::Length(pose->y_m)});
  }
  return scene::pattern_state(set, scene::shared_targets(set), places);
}

}  // namespace afm::exhibit
