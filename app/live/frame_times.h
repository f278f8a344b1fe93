// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace afm::app {

// How long each picture stood until the next one was shown, over a run of any length.
class FrameTimes {
 public:
  // A frame was shown, at a time of a clock that never goes back.
  void shown(std::int64_t now_ns);

  // Nobody sees the window: the time until the next frame says nothing.
  void hidden();

  // "picture: 214 frames, 10.8 a second; from one to the next p50 92.3, p99 110.2, p99.9 317.7, most 317.7 ms"; empty
  // before the second frame.
  std::string text() const;

 private:
  static constexpr std::int64_t kBinNs = 100'000;

  std::array<std::uint32_t, 10'001> bins_{};  // up to a second; the last holds all that is longer
  std::int64_t longest_ns_ = 0, total_ns_ = 0, last_ns_ = -1;
  std::uint64_t frames_ = 0, times_ = 0;
};

}  // namespace afm::app
