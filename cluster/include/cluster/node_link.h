// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cluster/frame_message.h"
#include "cluster/network.h"
#include "core/clock.h"
#include "core/result.h"

namespace afm::cluster {

// Node's end of a wall. DDS runs in a separate thread; every call except wait() is wait-free. Main thread only.
class NodeLink {
 public:
  static core::Result<std::unique_ptr<NodeLink>> open(const ClusterNetwork& network, const core::Clock& clock);
  NodeLink(const NodeLink&) = delete;
  NodeLink& operator=(const NodeLink&) = delete;
  ~NodeLink();

  struct Came {
    FrameMessage frame;
    std::int64_t came_ns = 0;
  };
  // Newest frame, if it arrived since the last call.
  std::optional<Came> frame();

  // Newest frame that may be shown: its session and its number, 0 before the first.
  std::pair<std::uint64_t, std::uint64_t> swapped() const;

  struct Numbered {
    std::uint64_t session = 0, number = 0;
    JournalRecord record;
  };
  std::optional<Numbered> record();

  struct Document {
    ClusterHeader header;
    std::vector<std::byte> bytes;
  };
  std::optional<Document> model();    // model received since the last call
  std::optional<Document> history();  // history received since the last call

  // Sends an answer, with the version and the time set.
  void answer(ReadyMessage ready);

  // Waits until something arrives, at most `timeout_ms`.
  void wait(int timeout_ms);

  std::uint64_t refused() const;  // number of invalid datagrams

 private:
  struct Parts;
  explicit NodeLink(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::cluster
