// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "physics/friction/sideways.h"
#include "physics/units.h"

namespace afm::physics {

// Particles on the places of a pattern, one on each.
struct PatternMatch {
  std::vector<std::size_t> particles;  // index of the assigned particle for each target
  Length rms;  // root mean square distance between targets and assigned particles; for rods, of the ends
};

// Direction and length of rods in a pattern.
struct PatternRods {
  std::span<const Sideways<double>> targets;    // unit vector along each target
  std::span<const Sideways<Length>> particles;  // vector from the middle of each particle to one end
};

// The assignment with the least sum of squared distances. A rod may lie either way round. There are at least as many
// particles as targets; without targets the match is empty. Takes targets^2 x particles steps. Source: shortest
// augmenting paths of Jonker & Volgenant, Computing 38 (1987) 325.
PatternMatch match_pattern(std::span<const Sideways<Length>> targets, std::span<const Sideways<Length>> particles,
                           const PatternRods& rods = {});

}  // namespace afm::physics
