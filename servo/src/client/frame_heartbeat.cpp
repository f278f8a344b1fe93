// SPDX-License-Identifier: Apache-2.0
#include "servo/frame_heartbeat.h"

namespace afm::servo {

namespace {

constexpr std::int64_t kLongestFrameNs = 2'000'000'000;

}  // namespace

void FrameHeartbeat::operator()() const {
  const std::int64_t now_ns = clock_.now_ns();
  if (now_ns - start_ns_ < kLongestFrameNs) servo_.beat(now_ns);
}

}  // namespace afm::servo
