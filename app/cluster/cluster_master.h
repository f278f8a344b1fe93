// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cluster/master_link.h"
#include "cluster/membership.h"
#include "core/clock.h"

namespace afm::exhibit {
class CycleHistory;
class FrictionHistory;
class LiveScan;
class Phrases;
}  // namespace afm::exhibit
namespace afm::render {
struct Banner;
}
namespace afm::scene {
struct Wall;
}

namespace afm::app {

class ParameterEdits;

// The live window as the master of a wall of several machines: sends the inputs of each frame, waits until every node
// that is there has drawn it, and lets all show it. Main thread only; nothing here waits for the network longer than
// the barrier's patience, during which the caller's heartbeat goes on.
class ClusterMaster {
 public:
  // All must outlive it.
  ClusterMaster(std::unique_ptr<cluster::MasterLink> link, const scene::Wall& wall, std::size_t materials,
                const core::Clock& clock);

  // For every node, in their order.
  void hear(const scene::TipSample& sample) { link_->record(cluster::JournalRecord(sample)); }
  void hear(const scene::TipEvent& event) { link_->record(cluster::JournalRecord(event)); }
  void forget() { link_->record(cluster::JournalRecord()); }

  // The scan that is shown, or none; `begun` counts those that were begun. Before what the hand does in a frame, and
  // again before it is sent.
  void follow_scan(const exhibit::LiveScan* scan, std::size_t material, std::uint64_t begun);

  // Sends the next frame, and what was felt before to a node that asks for it.
  void send(cluster::FrameMessage& frame, ParameterEdits& edits, const exhibit::CycleHistory& cycles,
            const exhibit::FrictionHistory& friction);

  // The frame has been built as it was sent.
  void built(std::uint64_t digest);

  // Waits until all that are awaited have drawn the frame, then lets them show it.
  void barrier(const std::function<void()>& while_waiting);

  // One line of numbers, at the end.
  void log_summary() const;

 private:
  void record_edits(ParameterEdits& edits);
  void take_answers();

  std::unique_ptr<cluster::MasterLink> link_;
  cluster::Membership membership_;
  const core::Clock& clock_;
  std::vector<std::optional<cluster::EditRecord>> edits_;  // as they were recorded last
  std::vector<cluster::ScanRecord> scan_;                  // likewise
  std::uint64_t scan_begun_ = 0;
  std::uint64_t number_ = 0;
  std::uint64_t waited_frames_ = 0;
  std::int64_t longest_wait_ns_ = 0;
  std::int64_t history_sent_ns_ = 0;
  bool history_wanted_ = false;
};

// The words of the wall's banner for the nodes of the mask; empty if none.
std::string missing_text(std::uint64_t missing, const scene::Wall& wall, const exhibit::Phrases& phrases);
void add_warning(const std::string& text, render::Banner& banner);

}  // namespace afm::app
