// SPDX-License-Identifier: Apache-2.0
#include "haptics/position_check.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace afm::haptics {

DeviceSample PositionCheck::checked(DeviceSample sample, std::int64_t elapsed_ns, const glm::dvec3& force_n) noexcept {
  if (!measured_) return sample;
  if (!sample.healthy || !is_within_reach(sample.position_m)) {
    started_ = false;  // acceptance of the first position after the failure
    return sample;
  }
  if (!started_) {
    *this = PositionCheck(true);
    started_ = true;
    read_m_ = believed_m_ = sample.position_m;
    return sample;
  }
  const bool changed = sample.position_m != read_m_;
  read_m_ = sample.position_m;
  forced_ns_ = changed || glm::length(force_n) < kStuckForceN ? 0 : forced_ns_ + elapsed_ns;

  believed_ns_ += elapsed_ns;
  const bool possible = is_possible(sample.position_m, elapsed_ns);
  doubt_ = std::max(0, doubt_ + (possible ? kPossible : kImpossible));
  if (possible && (changed || sample.position_m != believed_m_)) {
    believed_m_ = sample.position_m;
    believed_ns_ = 0;
  }
  sample.position_m = believed_m_;
  if (forced_ns_ >= kStuckNs) sample.healthy = false;
  if (doubt_ >= kMost) {
    sample.healthy = false;
    started_ = false;
  }
  return sample;
}

// A device that reports less often than the servo reads moves further between two reports, as does any device during a
// late tick.
bool PositionCheck::is_possible(const glm::dvec3& position_m, std::int64_t elapsed_ns) const noexcept {
  const std::int64_t time_ns = std::min(believed_ns_, std::max(kLongestGapNs, elapsed_ns));
  return glm::length(position_m - believed_m_) <= kSlackM + kFastestMPerS * 1e-9 * static_cast<double>(time_ns);
}

}  // namespace afm::haptics
