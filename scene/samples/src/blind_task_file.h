// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/samples/particle_set.h"

namespace afm::scene {

class TomlTable;

// Reads the table [task] of a particle file, whose particles and targets the set already has.
BlindTask read_blind_task(const TomlTable& top, const ParticleSet& set);

}  // namespace afm::scene
