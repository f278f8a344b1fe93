// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "scene/shared/particle_blocks.h"

namespace afm::exhibit {

// Notices that particles are jammed: the tip presses one of them sideways with kTimes the force at which it would give
// alone, and none moves. With more, a tip slips past it before it gives (haptics/particle_scale.h). Once for each
// press. One thread.
class JamWatch {
 public:
  static constexpr double kTimes = 3.0;

  // Call once a frame with the newest push. Returns the sideways force on the lever at a jam.
  std::optional<double> add(const scene::TipPush& push);

 private:
  std::uint64_t digest_ = 0;  // digest of the places in the frame before
  bool jammed_ = false;
};

}  // namespace afm::exhibit
