// SPDX-License-Identifier: Apache-2.0
#include "scene/samples/pattern_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "particle_field.h"

namespace afm::scene {

using physics::Length;
using physics::ParticlePlace;
using Vector = physics::Sideways<Length>;

namespace {

physics::Sideways<double> axis_of(const ParticlePlace& place) {
  const double angle = physics::angle_rad(place.turn);
  return {std::cos(angle), std::sin(angle)};
}

Vector end_of(const ParticlePlace& place, Length length) {
  const physics::Sideways<double> axis = axis_of(place);
  return {0.5 * axis.x * length, 0.5 * axis.y * length};
}

std::vector<Vector> positions_of(std::span<const ParticlePlace> places) {
  std::vector<Vector> positions;
  positions.reserve(places.size());
  for (const ParticlePlace& place : places) positions.push_back(place.position);
  return positions;
}

}  // namespace

Pattern pattern_of(const ParticleSet& set) { return {set.targets, set.pads, {}}; }
Pattern shared_pattern_of(const ParticleSet& set) {
  return {shared_targets(set), shared_pads(set), field_of(set).middle()};
}

// True if the axis has a part within the pad's range of x, then of y (Liang & Barsky, ACM Trans. Graphics 3 (1984) 1).
bool touches(const Pad& pad, const ParticlePlace& rod, Length length) {
  const Vector from = rod.position - pad.middle, end = end_of(rod, length);
  double first = -1.0, last = 1.0;
  for (const auto& [at, way, half] :
       {std::array{from.x.si, end.x.si, pad.half_size.x.si}, std::array{from.y.si, end.y.si, pad.half_size.y.si}}) {
    if (way == 0.0) {
      if (std::abs(at) > half) return false;
      continue;
    }
    const double enters = (-half - at) / way, leaves = (half - at) / way;
    first = std::max(first, std::min(enters, leaves));
    last = std::min(last, std::max(enters, leaves));
  }
  return first <= last;
}

std::optional<PatternState> pattern_state(const ParticleSet& set, const Pattern& pattern,
                                          std::span<const ParticlePlace> places) {
  if (pattern.targets.empty()) return std::nullopt;
  std::vector<Vector> movable, ends;
  std::vector<std::size_t> numbers;
  bool rods = false;
  PatternState state{.match = {}, .allowed = median_radius(set), .pads = pattern.pads.size(), .touched = 0};
  for (std::size_t i = 0; i < set.particles.size(); ++i) {
    if (set.particles[i].pinned) continue;
    const physics::ParticleSpecies& species = set.setup.species[set.particles[i].species];
    movable.push_back(places[i].position);
    ends.push_back(end_of(places[i], species.length));
    numbers.push_back(i);
    if (!physics::is_rod(species)) continue;
    rods = true;
    const auto touched = std::count_if(pattern.pads.begin(), pattern.pads.end(),
                                       [&](const Pad& pad) { return touches(pad, places[i], species.length); });
    state.touched = std::max(state.touched, static_cast<std::size_t>(touched));
  }
  if (movable.size() < pattern.targets.size()) return std::nullopt;
  std::vector<physics::Sideways<double>> axes;
  axes.reserve(pattern.targets.size());
  for (const ParticlePlace& target : pattern.targets) axes.push_back(axis_of(target));
  const physics::PatternRods directions = rods ? physics::PatternRods{axes, ends} : physics::PatternRods{};
  state.match = physics::match_pattern(positions_of(pattern.targets), movable, directions);
  for (std::size_t& particle : state.match.particles) particle = numbers[particle];
  return state;
}

}  // namespace afm::scene
