// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "physics/manipulation/pattern.h"
#include "scene/samples/particle_set.h"

namespace afm::scene {

// Distance of the particles of a set from its pattern.
struct PatternState {
  physics::PatternMatch match;  // match of particles, by their indices in the set, and targets
  physics::Length allowed;      // largest root mean square distance at which the pattern counts as done
  std::size_t pads = 0;         // number of pads in the set
  std::size_t touched = 0;      // largest number of pads touched by one rod

  // With pads, a pattern is done when a rod touches them all, however far it is from its target.
  bool done() const { return pads > 0 ? touched == pads : match.rms <= allowed; }
};

// Targets and pads of a set, in the frame of its particles' places.
struct Pattern {
  std::vector<physics::ParticlePlace> targets;
  std::vector<Pad> pads;
  physics::Sideways<physics::Length> origin{};  // place of this frame's origin in the frame of the file
};
Pattern pattern_of(const ParticleSet& set);         // pattern in the frame of the file
Pattern shared_pattern_of(const ParticleSet& set);  // pattern in the frame of a shared scene

// Particles that are pinned stay out. `places` are those of all particles, in the frame of the pattern. Empty without
// targets, or if there are more of them than particles that can be moved.
std::optional<PatternState> pattern_state(const ParticleSet& set, const Pattern& pattern,
                                          std::span<const physics::ParticlePlace> places);

// True if the axis of a rod passes over a pad.
bool touches(const Pad& pad, const physics::ParticlePlace& rod, physics::Length length);

}  // namespace afm::scene
