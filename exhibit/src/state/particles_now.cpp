// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/particles_now.h"

#include <vector>

#include "physics/manipulation/pattern.h"
#include "scene/samples/particle_set.h"

namespace afm::exhibit {

std::optional<PatternNow> pattern_of(const ParticlesNow& now) {
  using Place = physics::Sideways<physics::Length>;
  const scene::ParticleSet& set = *now.set;
  if (set.targets.empty()) return std::nullopt;
  std::vector<Place> places;
  for (std::size_t i = 0; i < set.particles.size(); ++i) {
    if (set.particles[i].pinned) continue;
    const auto pose = pose_of(now, i);
    if (!pose) return std::nullopt;
    places.push_back({physics::Length(pose->x_m), physics::Length(pose->y_m)});
  }
  const std::vector<Place> targets = scene::shared_targets(set);
  if (places.size() < targets.size()) return std::nullopt;
  return PatternNow{.off_m = physics::match_pattern(targets, places).rms.si, .allowed_m = scene::median_radius(set).si};
}

}  // namespace afm::exhibit
