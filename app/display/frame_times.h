// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace afm::app {

// Intervals between successive frames, over a run of any length.
class FrameTimes {
 public:
  // Records that a frame was shown at `now_ns` of a monotonic clock.
  void shown(std::int64_t now_ns);

  // Records that the window is invisible: the interval until the next frame does not count.
  void hidden();

  // Statistics such as "picture: 214 frames, 10.8 per second; interval p50 92.3, p99 110.2, p99.9 317.7, max 317.7 ms";
  // empty before the second frame.
  std::string text() const;

 private:
  static constexpr std::int64_t kBinNs = 100'000;

  std::array<std::uint32_t, 10'001> bins_{};  // one bin per 100 us, up to a second; the last holds everything longer
  std::int64_t longest_ns_ = 0, total_ns_ = 0, last_ns_ = -1;
  std::uint64_t frames_ = 0, times_ = 0;
};

}  // namespace afm::app
