// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cluster/messages.h"

namespace afm::cluster {

// Which nodes of a wall are waited for before a frame is shown. A node that misses three frames in a row is given up;
// one that answers three in a row in time is awaited again. Frame loop of the master only.
class Membership {
 public:
  // For a node that has been in time until now, and for one that missed the frame before: a refresh. Where the master
  // itself takes longer to draw, as without a GPU, a node may take as much longer, up to three times.
  static constexpr std::int64_t kPatienceNs = 50'000'000, kShortPatienceNs = 16'700'000;
  static constexpr std::int64_t kMostTimes = 3;
  static constexpr int kMostMissed = 3, kLeastInTime = 3;

  struct Node {
    std::string name;
    bool awaited = false;
    bool ready = false;  // with the current frame
    bool heard = false;  // ever
    NodeState state = NodeState::Loading;
    int missed = 0;                  // in a row
    int in_time = 0;                 // likewise, while it is not awaited
    std::uint64_t last_ready = 0;    // the newest frame that it has drawn
    std::uint64_t timeouts = 0;      // frames that were shown without it although it was awaited
    std::uint64_t other_frames = 0;  // that it built otherwise than the master
    ReadyMessage newest{};
  };

  explicit Membership(std::vector<std::string> names);

  // The next frame: its number, the digest of what the master has built, and when it begins to draw.
  void begin(std::uint64_t number, std::uint64_t digest, std::int64_t now_ns);

  // The master has drawn it: from now on it waits.
  void drawn(std::int64_t now_ns);

  // Of this wall, with when it came; a node that there is none of is ignored.
  void answer(const ReadyMessage& ready, std::int64_t came_ns);

  // The waiting may end: all are ready that are awaited, or the patience with those that are not is over.
  bool complete(std::int64_t now_ns) const;

  // The waiting has ended. Lines for the log: who is given up, is back, or builds other frames.
  std::vector<std::string> end();

  std::uint64_t missing() const;  // a bit for each node that is not awaited
  std::span<const Node> nodes() const { return nodes_; }

 private:
  struct Sent {
    std::uint64_t number = 0, digest = 0;
    std::int64_t begun_ns = 0;
    std::int64_t drawn_ns = 0;  // 0: not yet

    std::int64_t patience_ns(std::int64_t least_ns) const;
  };
  static constexpr std::size_t kRemembered = 8;  // frames

  const Sent* sent(std::uint64_t number) const;
  void count_in_time(Node& node, const Sent& frame, std::int64_t came_ns);

  std::vector<Node> nodes_;
  std::vector<Sent> sent_;
  std::uint64_t number_ = 0;
  std::vector<std::string> lines_;
};

}  // namespace afm::cluster
