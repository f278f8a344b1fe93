// SPDX-License-Identifier: Apache-2.0
#include "haptics/stroke_history.h"

namespace afm::haptics {

namespace {

constexpr std::size_t kPosesBesideNewest = std::size_t{16} * scene::kMostStrokes;

}  // namespace

StrokeHistory::StrokeHistory(std::size_t particle_count)
    : kept_(particle_count + kPosesBesideNewest), kept_in_(particle_count, 0) {}

bool StrokeHistory::keep(std::uint32_t particle, const scene::ParticlePose& before) noexcept {
  if (kept_in_[particle] == number_) return false;
  kept_in_[particle] = number_;
  if (!begun_) {
    begun_ = true;
    if (strokes_ == scene::kMostStrokes) forget_oldest();
    firsts_[newest_++ % scene::kMostStrokes] = end_;
    ++strokes_;
  }
  while (end_ - oldest() >= kept_.size()) forget_oldest();
  kept_[end_++ % kept_.size()] = {particle, before};
  return true;
}

}  // namespace afm::haptics
