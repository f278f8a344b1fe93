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

// Master's end of a wall of several machines. DDS runs in a separate thread; every call except wait() is wait-free.
// Frame loop only.
class MasterLink {
 public:
  // Listens for `listen_ms` first. WrongUsage: another master drives the wall. `model` is a document sent to every node
  // that joins.
  static core::Result<std::unique_ptr<MasterLink>> open(const ClusterNetwork& network, std::span<const std::byte> model,
                                                        int listen_ms, const core::Clock& clock);
  MasterLink(const MasterLink&) = delete;
  MasterLink& operator=(const MasterLink&) = delete;
  ~MasterLink();

  std::uint64_t session() const;

  // Sets the header and the time, and sends the frame.
  void send(std::uint64_t number, FrameMessage& frame);
  void swap(std::uint64_t number);

  // Sends the next record to all nodes. A record without room is lost: every node notices, and requests the history.
  void record(const JournalRecord& record);
  std::uint64_t recorded() const;  // number of records so far

  // Sends the combined effect of all records so far, for a node that lacks them.
  void send_history(std::span<const std::byte> history);
  bool sending_history() const;  // true while the last history is being sent

  // Next answer of a node and its time of arrival; empty if there is none.
  struct Answer {
    ReadyMessage ready;
    std::int64_t came_ns = 0;
  };
  std::optional<Answer> answer();

  // Waits for an answer, at most `timeout_ms`.
  void wait(int timeout_ms);

  // Another master that drives the same wall although both have listened first: they were started together, or in
  // networks that were joined later. Both decide alike: the one that started later must end.
  enum class Rival { None, Later, Earlier };
  Rival rival() const;

  std::uint64_t refused() const;       // number of invalid datagrams
  std::uint64_t lost() const;          // number of records and writes without room
  std::uint64_t resent_bytes() const;  // bytes sent again because a node had lost them; updated every sixteenth frame

 private:
  struct Parts;
  explicit MasterLink(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace afm::cluster
