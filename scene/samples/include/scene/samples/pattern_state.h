// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

#include "physics/manipulation/pattern.h"
#include "scene/samples/particle_set.h"

namespace afm::scene {

// How near the particles of a set are to its pattern.
struct PatternState {
  physics::PatternMatch match;  // numbers of particles in the set
  physics::Length allowed;      // largest root mean square distance of a pattern that is done

  bool done() const { return match.rms <= allowed; }
};

// Particles that are pinned stay out. `targets` are the set's and `places` those of all its particles, in one frame.
// Nothing without targets, or if there are more of them than particles that can be moved.
std::optional<PatternState> pattern_state(const ParticleSet& set,
                                          std::span<const physics::Sideways<physics::Length>> targets,
                                          std::span<const physics::Sideways<physics::Length>> places);

}  // namespace afm::scene
