// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/shared/particle_blocks.h"

namespace afm::haptics {

// Poses of the particles before the newest strokes of the tip, so that a stroke can be taken back. A stroke lasts from
// the place over the particles where the tip came down to the next one; one that moves no particle is not kept.
//
// The constructor allocates; everything else may be called in a tick of the servo, by its thread. When there is no room
// the oldest strokes are forgotten: the newest one, which may move every particle, always fits.
class StrokeHistory {
 public:
  explicit StrokeHistory(std::size_t particle_count);

  void begin() noexcept { begun_ = false, ++number_; }

  // Call before a particle is moved: the first pose in a stroke is the one that is kept. Returns whether it is.
  bool keep(std::uint32_t particle, const scene::ParticlePose& before) noexcept;

  std::size_t size() const noexcept { return strokes_; }

  // Calls `put(particle, pose)` for each particle that the newest stroke moved, and forgets the stroke. False without
  // one.
  template <class Put>
  bool take_back(Put&& put) noexcept {
    if (strokes_ == 0) return false;
    const std::uint64_t first = firsts_[--newest_ % scene::kMostStrokes];
    --strokes_;
    while (end_ > first) {
      const Kept& kept = kept_[--end_ % kept_.size()];
      put(kept.particle, kept.before);
    }
    begin();
    return true;
  }

 private:
  struct Kept {
    std::uint32_t particle = 0;
    scene::ParticlePose before;
  };

  void forget_oldest() noexcept { --strokes_; }
  std::uint64_t oldest() const noexcept { return firsts_[(newest_ - strokes_) % scene::kMostStrokes]; }

  std::vector<Kept> kept_;                                   // ring of poses
  std::uint64_t end_ = 0;                                    // number of poses ever kept, minus those taken back
  std::array<std::uint64_t, scene::kMostStrokes> firsts_{};  // ring of the first pose of each stroke
  std::uint64_t newest_ = 0;                                 // number of strokes ever kept, minus those taken back
  std::size_t strokes_ = 0;                                  // number of strokes that can be taken back
  std::uint64_t number_ = 1;                                 // number of the current stroke
  bool begun_ = false;                                       // true: the current stroke has a pose
  std::vector<std::uint64_t> kept_in_;                       // number of the stroke that last kept each particle
};

}  // namespace afm::haptics
