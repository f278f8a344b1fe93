// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cluster/messages.h"

namespace afm::cluster {

// Nodes of a wall that must be ready before a frame is shown. A node that misses three frames in a row is given up; one
// that answers three in a row in time is awaited again. Frame loop of the master only.
class Membership {
 public:
  // Patience with a node that has been in time so far, and with one that missed the previous frame: one refresh. If the
  // master itself takes longer to draw, as without a GPU, a node gets the same time, at most tripled.
  static constexpr std::int64_t kPatienceNs = 50'000'000, kShortPatienceNs = 16'700'000;
  static constexpr std::int64_t kMostTimes = 3;
  static constexpr int kMostMissed = 3, kLeastInTime = 3;

  struct Node {
    std::string name;
    bool awaited = false;
    bool ready = false;  // true: current frame drawn
    bool heard = false;  // true: at least one answer received
    NodeState state = NodeState::Loading;
    int missed = 0;                  // number of successive frames missed
    int in_time = 0;                 // number of successive frames in time, while not awaited
    std::uint64_t last_ready = 0;    // newest frame drawn by the node
    std::uint64_t timeouts = 0;      // number of frames shown without the node although it was awaited
    std::uint64_t other_frames = 0;  // number of frames that the node built differently from the master
    ReadyMessage newest{};
  };

  explicit Membership(std::vector<std::string> names);

  // Begins the next frame, with its number, the digest of the master's frame, and the time at which drawing starts.
  void begin(std::uint64_t number, std::uint64_t digest, std::int64_t now_ns);

  // Starts the patience, since the master has drawn the frame.
  void drawn(std::int64_t now_ns);

  // Handles an answer of this wall that arrived at `came_ns`; answers from unknown nodes are ignored.
  void answer(const ReadyMessage& ready, std::int64_t came_ns);

  // True if waiting may end: all awaited nodes are ready, or the patience with the others is over.
  bool complete(std::int64_t now_ns) const;

  // Ends the waiting. Returns lines for the log: nodes given up, back, or building different frames.
  std::vector<std::string> end();

  std::uint64_t missing() const;  // one bit per node that is not awaited
  std::span<const Node> nodes() const { return nodes_; }

 private:
  struct Sent {
    std::uint64_t number = 0, digest = 0;
    std::int64_t begun_ns = 0;
    std::int64_t drawn_ns = 0;  // time at which the master had drawn it; 0: not yet

    std::int64_t patience_ns(std::int64_t least_ns) const;
  };
  static constexpr std::size_t kRemembered = 8;  // number of frames

  const Sent* sent(std::uint64_t number) const;
  void count_in_time(Node& node, const Sent& frame, std::int64_t came_ns);

  std::vector<Node> nodes_;
  std::vector<Sent> sent_;
  std::uint64_t number_ = 0;
  std::vector<std::string> lines_;
};

}  // namespace afm::cluster
