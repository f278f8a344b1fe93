// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::exhibit {

// Sample rate of every stream. SDL converts to the sound card's rate.
inline constexpr int kSoundRateHz = 48'000;

// Index of the sample, in a stream that began at `start_ns`, nearest to `time_ns`.
constexpr std::int64_t sample_at(std::int64_t time_ns, std::int64_t start_ns) {
  const std::int64_t ns = time_ns - start_ns;
  const std::int64_t seconds = ns / 1'000'000'000, rest_ns = ns % 1'000'000'000;
  const std::int64_t half = rest_ns < 0 ? -500'000'000 : 500'000'000;
  return seconds * kSoundRateHz + (rest_ns * kSoundRateHz + half) / 1'000'000'000;
}

// Clock of a stream that a sound card reads. The card requests blocks at its own pace, a little early or late, and its
// clock differs from the system's. The estimated start follows the observations slowly, which preserves the rhythm, and
// jumps when the stream was interrupted. Audio thread only; neither allocates nor locks.
class StreamClock {
 public:
  // Reports that the block that begins with sample `position` was requested at `now_ns`.
  void asked(std::int64_t position, std::int64_t now_ns) noexcept;

  // Estimated time of sample 0.
  std::int64_t start_ns() const noexcept { return start_ns_; }

 private:
  bool known_ = false;
  std::int64_t start_ns_ = 0;
};

}  // namespace afm::exhibit
