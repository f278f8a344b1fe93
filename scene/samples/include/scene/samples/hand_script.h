// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "physics/units.h"
#include "scene/samples/particle_set.h"

// The scripted hand of a particle file in ticks of a rate.
namespace afm::scene {

// Ticks of a move from a place, at least one, without its wait.
std::size_t ticks_of(const physics::LeverBase& from, const HandMove& move, physics::Frequency rate);

// Ticks of the wait at the end of a move.
std::size_t waiting_ticks(const HandMove& move, physics::Frequency rate);

// Ticks of all moves from the start, and of their waits; a floating-point number, since a slow hand takes more than any
// counter holds.
double all_ticks(const ParticleSet& set, physics::Frequency rate);

// The place at a share of the straight way from a to b.
physics::LeverBase on_the_way(const physics::LeverBase& a, const physics::LeverBase& b, double share);

}  // namespace afm::scene
