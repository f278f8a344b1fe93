// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "physics/units.h"
#include "scene/samples/particle_set.h"

// The scripted hand of a particle file in ticks of a rate.
namespace afm::scene {

// A sweep runs in lines across its path, back and forth, each one line spacing farther on: half a line to the left of
// the start, then on and across, on and back, and so on, and half a line to the end. The height changes evenly.

// Number of lines of a sweep from a place, enough to keep their spacing at most that of the move; 0: straight, or no
// movement.
double lines_of(const physics::LeverBase& from, const HandMove& move);

// Ticks of a move from a place, at least one, without its wait.
std::size_t ticks_of(const physics::LeverBase& from, const HandMove& move, physics::Frequency rate);

// Ticks of the wait at the end of a move.
std::size_t waiting_ticks(const HandMove& move, physics::Frequency rate);

// Ticks of all moves from the start, and of their waits; a floating-point number, since a slow hand takes more than any
// counter holds.
double all_ticks(const ParticleSet& set, physics::Frequency rate);

// Place at a fraction of a move's path; at 1 its end.
physics::LeverBase on_the_way(const physics::LeverBase& from, const HandMove& move, double share);

}  // namespace afm::scene
