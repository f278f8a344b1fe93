// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::exhibit {

// Samples a second of every stream. The sound card's own rate is SDL's affair.
inline constexpr int kSoundRateHz = 48'000;

// The sample of a stream that began at `start_ns` in which something at `time_ns` is heard; the nearest one.
constexpr std::int64_t sample_at(std::int64_t time_ns, std::int64_t start_ns) {
  const std::int64_t ns = time_ns - start_ns;
  const std::int64_t seconds = ns / 1'000'000'000, rest_ns = ns % 1'000'000'000;
  const std::int64_t half = rest_ns < 0 ? -500'000'000 : 500'000'000;
  return seconds * kSoundRateHz + (rest_ns * kSoundRateHz + half) / 1'000'000'000;
}

// Times of a stream that a sound card pulls: it asks for blocks at its own pace, a little early or late, and its clock
// is not the system's. The stream's start drifts slowly after what is observed, so that what is heard keeps its rhythm,
// and jumps where the stream was interrupted. The audio thread alone; neither allocates nor locks.
class StreamClock {
 public:
  // The block that begins with sample `position` is asked for at `now_ns`.
  void asked(std::int64_t position, std::int64_t now_ns) noexcept;

  // When sample 0 was asked for, as far as known.
  std::int64_t start_ns() const noexcept { return start_ns_; }

 private:
  bool known_ = false;
  std::int64_t start_ns_ = 0;
};

}  // namespace afm::exhibit
