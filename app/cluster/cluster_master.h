// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cluster/master_link.h"
#include "cluster/membership.h"
#include "core/clock.h"

namespace afm::exhibit {
class CycleHistory;
class FrictionHistory;
class LiveScan;
class Phrases;
struct ParticlesNow;
}  // namespace afm::exhibit
namespace afm::render {
struct Banner;
}
namespace afm::scene {
struct Wall;
}

namespace afm::app {

class ParameterEdits;

// The live window as the master of a wall of several machines: sends the inputs of each frame, waits until every
// connected node has drawn it, and lets all show it. Main thread only. Waits for the network no longer than the
// barrier's patience, and calls the heartbeat meanwhile.
class ClusterMaster {
 public:
  // All arguments must outlive the object. `contact_m`: the contact point, in the room.
  ClusterMaster(std::unique_ptr<cluster::MasterLink> link, const scene::Wall& wall, const glm::dvec3& contact_m,
                std::size_t materials, const core::Clock& clock);

  // Sends the sample to every node. Call in the order of the samples.
  void hear(const scene::TipSample& sample) { link_->record(cluster::JournalRecord(sample)); }
  void hear(const scene::TipEvent& event) { link_->record(cluster::JournalRecord(event)); }
  void forget() { link_->record(cluster::JournalRecord()); }

  // Follows the visible scan, null if none; `begun` is the number of scans started. Call before a frame applies the
  // hand's motion, and again before the frame is sent.
  void follow_scan(const exhibit::LiveScan* scan, std::size_t material, std::uint64_t begun);

  // Sends the poses that have changed, the push, a score and a picture that have changed, and rows of marks that have
  // changed, as many as fit. Call before the frame that shows them is sent; `count`: number of particles.
  void follow_particles(const exhibit::ParticlesNow& now, std::size_t count);

  // The same particles with the marks that have been sent; valid until the next follow_particles().
  exhibit::ParticlesNow as_recorded(exhibit::ParticlesNow now) const;

  // Sends the next frame, and the history to a node that asks for it.
  void send(cluster::FrameMessage& frame, ParameterEdits& edits, const exhibit::CycleHistory& cycles,
            const exhibit::FrictionHistory& friction);

  // Reports that the frame was built as sent; `digest` is the digest of its contents.
  void built(std::uint64_t digest);

  // Waits until all connected nodes have drawn the frame, then lets them show it.
  void barrier(const std::function<void()>& while_waiting);

  // Reason to end, if another master that started earlier drives the wall. Logs one that started later. Call once a
  // frame.
  std::optional<core::Error> rival();

  // True if a screen of a node shows the sample.
  bool nodes_show_sample() const;

  // Newest time at which a node that shows the sample had drawn it for visible windows; `now_ns` while such a node is
  // awaited.
  std::int64_t seen_ns(std::int64_t now_ns) const;

  // True once after each press of Stop at a node.
  bool take_stop() { return std::exchange(stop_pressed_, false); }

  // Logs one line of statistics at the end of a run.
  void log_summary() const;

 private:
  void record_edits(ParameterEdits& edits);
  void follow_marks(const exhibit::ParticlesNow& now);
  void take_answers();

  // State of a node, from its answers.
  struct Told {
    bool shows_sample = false;
    bool heard = false;
    std::uint32_t stops = 0;
    std::int64_t seen_ns = 0;  // arrival of the newest answer from a node whose picture is visible
  };
  void follow(const cluster::ReadyMessage& ready, std::int64_t came_ns);

  std::unique_ptr<cluster::MasterLink> link_;
  cluster::Membership membership_;
  const core::Clock& clock_;
  std::vector<std::optional<cluster::EditRecord>> edits_;  // newest recorded edit of each material
  std::vector<cluster::ScanRecord> scan_;                  // newest recorded state of the scan
  std::uint64_t scan_begun_ = 0;
  std::vector<scene::ParticlePage> pages_;  // pages as recorded
  std::vector<std::uint8_t> known_;         // servo::Known of each pose, as recorded
  scene::TipPush push_;
  scene::TaskScore score_;
  scene::PlannedPush plan_;
  cluster::PictureRecord picture_;
  std::vector<scene::MarkTile> tiles_;  // tiles as recorded; empty: no marks
  std::uint64_t marks_ = 0;             // number of recorded rows
  std::uint64_t marks_heard_ = 0;       // value of ParticlesNow::marks in the newest frame
  bool more_marks_ = false;             // true: more rows of these marks to send
  std::uint64_t number_ = 0;
  std::uint64_t waited_frames_ = 0;
  std::int64_t longest_wait_ns_ = 0;
  std::int64_t history_sent_ns_ = 0;
  bool history_wanted_ = false;
  bool rival_logged_ = false;
  std::vector<Told> told_;  // one entry per node
  bool stop_pressed_ = false;
};

// Text of the wall's banner for the nodes in the mask; empty if none is missing.
std::string missing_text(std::uint64_t missing, const scene::Wall& wall, const exhibit::Phrases& phrases);
void add_warning(const std::string& text, render::Banner& banner);

}  // namespace afm::app
