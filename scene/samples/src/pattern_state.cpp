// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/pattern_state.h"

#include <cstddef>
#include <vector>

namespace afm::scene {

using Place = physics::Sideways<physics::Length>;

std::optional<PatternState> pattern_state(const ParticleSet& set, std::span<const Place> targets,
                                          std::span<const Place> places) {
  if (targets.empty()) return std::nullopt;
  std::vector<Place> movable;
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < set.particles.size(); ++i) {
    if (set.particles[i].pinned) continue;
    movable.push_back(places[i]);
    numbers.push_back(i);
  }
  if (movable.size() < targets.size()) return std::nullopt;
  PatternState state{.match = physics::match_pattern(targets, movable), .allowed = median_radius(set)};
  for (std::size_t& particle : state.match.particles) particle = numbers[particle];
  return state;
}

}  // namespace afm::scene
