// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "cluster/messages.h"

namespace afm::cluster {

// Offset of a node's clock from this machine's, from the four times of a round trip (RFC 5905, section 8). The shortest
// round trip wins: the error is at most half its length.
class ClockOffset {
 public:
  // Adds an answer to a frame, received at `came_ns` on this machine's clock. Returns the length of the round trip
  // without the node's own time.
  std::int64_t add(const ReadyMessage& ready, std::int64_t came_ns) {
    const std::int64_t there_ns = ready.frame_came_ns - ready.frame_sent_ns;
    const std::int64_t back_ns = came_ns - ready.ready_sent_ns;
    const std::int64_t round_ns = there_ns + back_ns;
    if (!shortest_ns_ || round_ns < *shortest_ns_) {
      shortest_ns_ = round_ns;
      ahead_ns_ = (there_ns - back_ns) / 2;
    }
    return round_ns;
  }

  // 0 before the first answer.
  std::int64_t ahead_ns() const { return ahead_ns_; }

 private:
  std::optional<std::int64_t> shortest_ns_;
  std::int64_t ahead_ns_ = 0;
};

}  // namespace afm::cluster
