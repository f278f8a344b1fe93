// SPDX-License-Identifier: Apache-2.0
#include "exhibit/state/particles_now.h"

#include <algorithm>
#include <limits>

#include "physics/manipulation/push_figures.h"
#include "physics/manipulation/pushed_particles.h"
#include "scene/samples/particle_set.h"
#include "scene/samples/pattern_state.h"
#include "servo/live_picture.h"

namespace afm::exhibit {

servo::Known known_of(const ParticlesNow& now, std::size_t particle) {
  const bool told = now.picture != nullptr && particle < now.picture->known.size();
  return told ? now.picture->known[particle] : servo::Known::Measured;
}

physics::Force gentle_look(const scene::ParticleSet& set) {
  physics::Force gentle{std::numeric_limits<double>::infinity()};
  for (const physics::ParticleSpecies& species : set.setup.species) {
    gentle = std::min(gentle, physics::climbing_load(species, set.setup.tip, set.setup.tip_friction));
  }
  return gentle;
}

std::optional<std::vector<physics::ParticlePlace>> places_of(const ParticlesNow& now) {
  std::vector<physics::ParticlePlace> places;
  for (std::size_t i = 0; i < now.set->particles.size(); ++i) {
    const auto pose = pose_of(now, i);
    if (!pose) return std::nullopt;
    places.push_back({{physics::Length(pose->x_m), physics::Length(pose->y_m)}, scene::turn_of(*pose)});
  }
  return places;
}

std::optional<scene::PatternState> pattern_of(const ParticlesNow& now) {
  const scene::ParticleSet& set = *now.set;
  if (set.targets.empty()) return std::nullopt;
  const auto places = places_of(now);
  return places ? scene::pattern_state(set, scene::shared_pattern_of(set), *places) : std::nullopt;
}

}  // namespace afm::exhibit
