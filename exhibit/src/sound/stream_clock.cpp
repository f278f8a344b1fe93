// SPDX-License-Identifier: Apache-2.0
#include "exhibit/sound/stream_clock.h"

namespace afm::exhibit {

namespace {

constexpr std::int64_t kInterruptedNs = 40'000'000;
constexpr std::int64_t kBlocksToFollow = 64;  // a third of a second; a card's clock differs by some 1e-4

}  // namespace

void StreamClock::asked(std::int64_t position, std::int64_t now_ns) noexcept {
  const std::int64_t seconds = position / kSoundRateHz, rest = position % kSoundRateHz;
  const std::int64_t seen_ns = now_ns - seconds * 1'000'000'000 - rest * 1'000'000'000 / kSoundRateHz;
  const std::int64_t off_ns = seen_ns - start_ns_;
  const bool jump = !known_ || off_ns > kInterruptedNs || off_ns < -kInterruptedNs;
  start_ns_ += jump ? off_ns : off_ns / kBlocksToFollow;
  known_ = true;
}

}  // namespace afm::exhibit
