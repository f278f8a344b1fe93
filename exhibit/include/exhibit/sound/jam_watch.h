// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "scene/shared/particle_blocks.h"

namespace afm::exhibit {

// Detects jammed particles: the tip presses one of them sideways with kTimes the force at which it would move
// alone, and none moves. With an even larger force, a tip slips past it before it moves (haptics/particle_scale.h).
// Reports once for each press. One thread.
class JamWatch {
 public:
  static constexpr double kTimes = 3.0;

  // Call once a frame with the newest push. Returns the sideways force on the lever at a jam.
  std::optional<double> add(const scene::TipPush& push);

 private:
  std::uint64_t digest_ = 0;  // digest of the places in the previous frame
  bool jammed_ = false;
};

}  // namespace afm::exhibit
