// SPDX-License-Identifier: Apache-2.0
#include "app/cluster/cluster_master.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/display/view_outputs.h"
#include "app/view/parameter_edits.h"
#include "core/log.h"
#include "exhibit/cluster/shared_picture.h"
#include "exhibit/cluster/wall_history.h"
#include "exhibit/friction/friction_history.h"
#include "exhibit/scan/live_scan.h"
#include "exhibit/state/cycle_history.h"
#include "exhibit/state/particles_now.h"
#include "exhibit/words/phrases.h"
#include "scene/samples/particle_set.h"

namespace afm::app {

namespace {

constexpr std::int64_t kHistoryPauseNs = 500'000'000;  // shortest time between two histories sent to nodes
constexpr int kBeatMs = 2;                             // time between two heartbeats while the barrier waits
constexpr std::size_t kMostRowsOfFrame = 128;          // number of rows of marks in a frame: 53 kB

std::vector<std::string> names_of(const std::vector<scene::WallNode>& nodes) {
  std::vector<std::string> names;
  names.reserve(nodes.size());
  for (const scene::WallNode& node : nodes) names.push_back(node.name);
  return names;
}

}  // namespace

ClusterMaster::ClusterMaster(std::unique_ptr<cluster::MasterLink> link, const scene::Wall& wall,
                             const glm::dvec3& contact_m, std::size_t materials, const core::Clock& clock)
    : link_(std::move(link)),
      membership_(names_of(wall.nodes)),
      clock_(clock),
      edits_(materials),
      told_(wall.nodes.size()) {
  for (const scene::Output& output : wall.outputs) {
    if (output.node && holds(wall.screens[output.screen], contact_m)) told_[*output.node].shows_sample = true;
  }
}

bool ClusterMaster::nodes_show_sample() const {
  return std::any_of(told_.begin(), told_.end(), [](const Told& told) { return told.shows_sample; });
}

void ClusterMaster::follow(const cluster::ReadyMessage& ready, std::int64_t came_ns) {
  if (ready.header.node >= told_.size()) return;
  Told& told = told_[ready.header.node];
  // a node that begins again counts from none
  if (std::exchange(told.heard, true) && ready.stops > told.stops) stop_pressed_ = true;
  told.stops = ready.stops;
  if (ready.state == cluster::NodeState::Drawing && ready.unseen == 0) told.seen_ns = came_ns;
}

std::int64_t ClusterMaster::seen_ns(std::int64_t now_ns) const {
  const std::span<const cluster::Membership::Node> nodes = membership_.nodes();
  std::int64_t newest_ns = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!told_[i].shows_sample) continue;
    const bool there = nodes[i].awaited && nodes[i].newest.unseen == 0;
    newest_ns = std::max(newest_ns, there ? now_ns : told_[i].seen_ns);
  }
  return newest_ns;
}

void ClusterMaster::record_edits(ParameterEdits& edits) {
  for (std::size_t i = 0; i < edits_.size(); ++i) {
    const auto now = edits.recorded(i);
    if (!now || now == edits_[i]) continue;
    edits_[i] = now;
    link_->record(cluster::JournalRecord(*now));
  }
}

void ClusterMaster::follow_scan(const exhibit::LiveScan* scan, std::size_t material, std::uint64_t begun) {
  using Kind = cluster::JournalKind;
  const auto record = [&](Kind kind, const cluster::ScanRecord& entry) {
    link_->record(cluster::JournalRecord(kind, entry));
  };
  if (scan == nullptr) {
    if (!scan_.empty()) record(Kind::ScanEnd, {});
    return scan_.clear();
  }
  const exhibit::ScanProgress& progress = scan->progress();
  const cluster::ScanRecord newest = exhibit::record_of(progress.changes.back(), material, progress.hand);
  if (scan_.empty() || std::exchange(scan_begun_, begun) != begun) {
    scan_begun_ = begun;
    scan_.assign(1, newest);
    record(Kind::ScanBegin, newest);
  } else if (scan_.back() != newest) {
    exhibit::add_change(newest, scan_);
    record(Kind::ScanChange, newest);
  }
}

void ClusterMaster::follow_particles(const exhibit::ParticlesNow& now, std::size_t count) {
  const std::size_t before = pages_.size();
  pages_.resize(std::max(before, now.pages.size()));
  known_.resize(pages_.size() * scene::kPosesPerPage);
  for (std::size_t i = 0; i < std::min(count, now.pages.size() * scene::kPosesPerPage); ++i) {
    const std::size_t page = i / scene::kPosesPerPage;
    scene::ParticlePose& sent = pages_[page].poses[i % scene::kPosesPerPage];
    const scene::ParticlePose& pose = now.pages[page].poses[i % scene::kPosesPerPage];
    const auto known = static_cast<std::uint8_t>(exhibit::known_of(now, i));
    if (page < before && sent == pose && known_[i] == known) continue;
    sent = pose;
    known_[i] = known;
    link_->record(cluster::JournalRecord(
        cluster::PoseRecord{.particle = static_cast<std::uint32_t>(i), .known = known, .pose = pose}));
  }
  push_ = now.push;
  link_->record(cluster::JournalRecord(push_));
  if (std::exchange(score_, now.score) != now.score) link_->record(cluster::JournalRecord(score_));
  if (std::exchange(plan_, now.plan) != now.plan) link_->record(cluster::JournalRecord(plan_));
  const cluster::PictureRecord picture = exhibit::record_of(now);
  if (std::exchange(picture_, picture) != picture) link_->record(cluster::JournalRecord(picture_));
  follow_marks(now);
}

// Sends changed marks; those that do not fit into a frame follow in the next ones.
void ClusterMaster::follow_marks(const exhibit::ParticlesNow& now) {
  if (!scene::leaves_marks(*now.set)) return;
  tiles_.resize(scene::kMarkTiles);
  if (now.tiles.empty() || (std::exchange(marks_heard_, now.marks) == now.marks && !more_marks_)) return;
  const std::vector<cluster::MarkRecord> rows = exhibit::changed_rows(tiles_, now.tiles, kMostRowsOfFrame);
  more_marks_ = rows.size() == kMostRowsOfFrame;
  for (const cluster::MarkRecord& row : rows) {
    exhibit::put_row(row, tiles_);
    link_->record(cluster::JournalRecord(row));
  }
  marks_ += rows.size();
}

exhibit::ParticlesNow ClusterMaster::as_recorded(exhibit::ParticlesNow now) const {
  now.tiles = tiles_;
  now.marks = marks_;
  return now;
}

void ClusterMaster::send(cluster::FrameMessage& frame, ParameterEdits& edits, const exhibit::CycleHistory& cycles,
                         const exhibit::FrictionHistory& friction) {
  record_edits(edits);
  frame.missing = membership_.missing();
  const std::int64_t now_ns = clock_.now_ns();
  if (history_wanted_ && !link_->sending_history() && now_ns - history_sent_ns_ >= kHistoryPauseNs) {
    history_wanted_ = false;
    history_sent_ns_ = now_ns;
    std::vector<cluster::EditRecord> newest;
    for (const auto& edit : edits_) {
      if (edit) newest.push_back(*edit);
    }
    const auto history = exhibit::save_history(link_->recorded(), cycles, friction, newest, scan_, pages_, push_,
                                               score_, plan_, tiles_, known_, picture_);
    if (history.size() <= cluster::kMostDocumentBytes) link_->send_history(history);
  }
  link_->send(++number_, frame);
}

void ClusterMaster::built(std::uint64_t digest) { membership_.begin(number_, digest, clock_.now_ns()); }

void ClusterMaster::take_answers() {
  while (const auto answer = link_->answer()) {
    membership_.answer(answer->ready, answer->came_ns);
    follow(answer->ready, answer->came_ns);
    history_wanted_ = history_wanted_ || answer->ready.wants_history != 0;
  }
}

void ClusterMaster::barrier(const std::function<void()>& while_waiting) {
  const std::int64_t since_ns = clock_.now_ns();
  membership_.drawn(since_ns);
  take_answers();
  while (!membership_.complete(clock_.now_ns())) {
    while_waiting();
    link_->wait(kBeatMs);
    take_answers();
  }
  const std::int64_t waited_ns = clock_.now_ns() - since_ns;
  longest_wait_ns_ = std::max(longest_wait_ns_, waited_ns);
  ++waited_frames_;
  link_->swap(number_);
  for (const std::string& line : membership_.end()) core::log_line(line);
}

std::optional<core::Error> ClusterMaster::rival() {
  using Rival = cluster::MasterLink::Rival;
  const Rival rival = link_->rival();
  if (rival == Rival::Earlier) {
    return core::Error{core::ErrorCategory::WrongUsage,
                       "another master, which started earlier, drives a wall in this network and domain: end it first, "
                       "or give one of the two another --domain"};
  }
  const bool later = rival == Rival::Later;
  if (later && !rival_logged_) {
    core::log_line(
        "cluster: another master drives a wall in this network and domain; it started later and should end by itself");
  }
  rival_logged_ = later;
  return std::nullopt;
}

void ClusterMaster::log_summary() const {
  for (const cluster::Membership::Node& node : membership_.nodes()) {
    core::log_line(
        fmt::format("cluster: node {}: {} frames late, {} built otherwise, {} samples repaired, {} shown "
                    "without a word, {:.1f} ms to draw the last one",
                    node.name, node.timeouts, node.other_frames, node.newest.lost_records, node.newest.late_swaps,
                    1e-3 * node.newest.draw_us));
  }
  core::log_line(fmt::format("cluster: {} frames; longest wait {:.1f} ms; {} datagrams refused, {} lost on the way",
                             waited_frames_, 1e-6 * static_cast<double>(longest_wait_ns_), link_->refused(),
                             link_->lost()));
}

std::string missing_text(std::uint64_t missing, const scene::Wall& wall, const exhibit::Phrases& phrases) {
  std::string names;
  for (std::size_t i = 0; i < wall.nodes.size(); ++i) {
    if ((missing >> i & 1U) != 0) names += (names.empty() ? "" : ", ") + wall.nodes[i].name;
  }
  return names.empty() ? "" : phrases.filled(exhibit::Phrase::NodeMissing, std::span(&names, 1));
}

void add_warning(const std::string& text, render::Banner& banner) {
  if (!text.empty()) banner.warning += (banner.warning.empty() ? "" : ", ") + text;
}

}  // namespace afm::app
