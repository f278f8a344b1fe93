// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/config/toml_table.h"
#include "scene/samples/particle_set.h"

namespace afm::scene {

// Reads the table [sample] of a particle file, with tip and lever, into a set that has title and medium alone.
void read_soft_sample(const TomlTable& top, ParticleSet& set);

// Refuses moves that a soft sample of this set cannot bear, or that leave the largest surface. `top` is that of the
// set.
void check_soft_moves(const TomlTable& top, const ParticleSet& set);

// The same for the table [ink], without tip and lever.
void read_ink(const TomlTable& top, ParticleSet& set);

}  // namespace afm::scene
