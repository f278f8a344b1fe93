// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.h"

namespace afm::scene {

struct SharedParticles;

// Level and seed of particles that a hand pushes (SharedLevel), as a person chooses them.
struct LevelChoice {
  int level = 0;  // 0 to kHighestLevel
  int seed = 1;   // 1 to kLargestSeed
};

// Sets the level of valid particles. WrongUsage with the reason if they have no picture of that level.
core::Result<void> set_level(const LevelChoice& choice, SharedParticles& particles);

}  // namespace afm::scene
