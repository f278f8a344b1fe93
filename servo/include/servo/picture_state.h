// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/shared/particle_blocks.h"

namespace afm::servo {

// Places in a picture at a moment, in the scanner's frame, and the times at which they were measured, as in TipState.
struct PictureState {
  std::vector<scene::ParticlePage> shown{}, measured{};  // pages_of() the particles
  std::vector<std::int64_t> seen_ns{};                   // one for each particle

  bool empty() const { return seen_ns.empty(); }
};

}  // namespace afm::servo
