// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "cluster/frame_message.h"
#include "cluster/network.h"
#include "core/clock.h"
#include "core/result.h"

namespace afm::cluster {

// The master's end of a wall of several machines. DDS runs in a separate thread; every call but
// wait() is wait-free. Frame loop only.
class MasterLink {
 public:
  // Listens for `listen_ms` first. WrongUsage: another master drives the wall. `model` is a document for every node
  // that comes.
  static core::Result<std::unique_ptr<MasterLink>> open(const ClusterNetwork& network, std::span<const std::byte> model,
                                                        int listen_ms, const core::Clock& clock);
  MasterLink(const MasterLink&) = delete;
  MasterLink& operator=(const MasterLink&) = delete;
  ~MasterLink();

  std::uint64_t session() const;

  // Sets header and time.
  void send(std::uint64_t number, FrameMessage& frame);
  void swap(std::uint64_t number);

  // The next record for all. One that finds no room is lost: every node notices it, and asks for the history.
  void record(const JournalRecord& record);
  std::uint64_t recorded() const;  // how many until now

  // What all that was recorded until now amounts to, for a node that lacks it.
  void send_history(std::span<const std::byte> history);
  bool sending_history() const;  // the last one is still on its way

  // The next answer of a node, and when it came; or nothing.
  struct Answer {
    ReadyMessage ready;
    std::int64_t came_ns = 0;
  };
  std::optional<Answer> answer();

  // Until an answer comes, at most so long.
  void wait(int timeout_ms);

  std::uint64_t refused() const;       // datagrams that were no valid message
  std::uint64_t lost() const;          // records and writes that found no room
  std::uint64_t resent_bytes() const;  // what a node had lost was sent again; counted every sixteenth frame

 private:
  struct Parts;
  explicit MasterLink(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::cluster
