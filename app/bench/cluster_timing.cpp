// SPDX-License-Identifier: Apache-2.0
#include "app/bench/cluster_timing.h"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <optional>
#include <thread>
#include <utility>

#include "cluster/clock_offset.h"
#include "cluster/master_link.h"
#include "cluster/membership.h"
#include "cluster/node_link.h"
#include "core/interruption.h"
#include "core/percentiles.h"

namespace afm::app {

namespace {

constexpr int kSamplesAFrame = 17;  // samples of one frame, with a servo at 1 kHz
constexpr auto kDrawing = std::chrono::milliseconds(2);
constexpr std::int64_t kComeNs = 20'000'000'000;  // longest wait until the nodes have joined
// Number of frames that are not counted as lost. A new reader misses data written before its writer discovered it. A
// real node gets those records with the history; here every node has noticed the gap after this number of frames.
constexpr int kFramesToJoin = 30;
constexpr double kMsPerNs = 1e-6;

double process_cpu_s() {
  timespec used{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &used);
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

// Times at which each node has shown a frame, on the master's clock.
class SwapTimes {
 public:
  explicit SwapTimes(std::uint32_t nodes) : clocks_(nodes) {}

  void answer(const cluster::ReadyMessage& ready, std::int64_t came_ns, ClusterTiming& timing) {
    const std::int64_t round_ns = clocks_[ready.header.node].add(ready, came_ns);
    timing.round_ms.push_back(kMsPerNs * static_cast<double>(round_ns));
    if (ready.swapped_ns != 0) shown_[ready.header.number - 1].push_back({ready.header.node, ready.swapped_ns});
  }

  void sent(std::uint64_t number, std::int64_t at_ns) { sent_[number] = at_ns; }

  void finish(ClusterTiming& timing) const {
    for (const auto& [number, times] : shown_) {
      const auto sent = sent_.find(number);
      if (times.size() != clocks_.size() || sent == sent_.end()) continue;
      std::vector<std::int64_t> here;
      for (const auto& [node, at_ns] : times) here.push_back(at_ns - clocks_[node].ahead_ns());
      const auto [first, last] = std::minmax_element(here.begin(), here.end());
      timing.skew_ms.push_back(kMsPerNs * static_cast<double>(*last - *first));
      timing.latency_ms.push_back(kMsPerNs * static_cast<double>(*last - sent->second));
    }
    for (const cluster::ClockOffset& clock : clocks_) {
      timing.clock_ms.push_back(kMsPerNs * static_cast<double>(clock.ahead_ns()));
    }
  }

 private:
  std::vector<cluster::ClockOffset> clocks_;  // one clock per node
  std::map<std::uint64_t, std::vector<std::pair<std::uint32_t, std::int64_t>>> shown_;
  std::map<std::uint64_t, std::int64_t> sent_;
};

cluster::FrameMessage still_frame() {
  cluster::FrameMessage frame;
  for (std::size_t i = 0; i < 4; ++i) frame.moment.navigation[5 * i] = 1.0;
  return frame;
}

// Sends the frames of one wall.
class TimedMaster {
 public:
  TimedMaster(cluster::MasterLink& link, const ClusterTimingPlan& plan, const core::Clock& clock)
      : link_(link), plan_(plan), clock_(clock), membership_(names(plan.nodes)), times_(plan.nodes) {}

  // Returns whether all nodes took part in the frame.
  bool frame(ClusterTiming* timing) {
    const std::int64_t begun_ns = clock_.now_ns();
    scene::TipSample sample;
    sample.material = 0;
    for (int i = 0; i < kSamplesAFrame; ++i) link_.record(cluster::JournalRecord(sample));
    cluster::FrameMessage message = still_frame();
    link_.send(++number_, message);
    membership_.begin(number_, 0, message.sent_ns);
    if (timing != nullptr) times_.sent(number_, message.sent_ns);
    std::this_thread::sleep_for(kDrawing);
    const std::int64_t since_ns = clock_.now_ns();
    membership_.drawn(since_ns);
    take(timing);
    while (!membership_.complete(clock_.now_ns())) {
      link_.wait(1);
      take(timing);
    }
    if (timing != nullptr) timing->barrier_ms.push_back(kMsPerNs * static_cast<double>(clock_.now_ns() - since_ns));
    link_.swap(number_);
    membership_.end();
    const auto left_ns = static_cast<std::int64_t>(1e9 / plan_.frames_per_s) - (clock_.now_ns() - begun_ns);
    if (left_ns > 0) std::this_thread::sleep_for(std::chrono::nanoseconds(left_ns));
    return membership_.missing() == 0;
  }

  // `before`: state of the nodes when the measurement began.
  void finish(ClusterTiming& timing, std::span<const cluster::Membership::Node> before) const {
    times_.finish(timing);
    for (std::size_t i = 0; i < before.size(); ++i) {
      const cluster::Membership::Node& node = membership_.nodes()[i];
      const std::uint64_t lost = node.newest.lost_records, lost_before = before[i].newest.lost_records;
      timing.timeouts.push_back(node.timeouts - before[i].timeouts);
      // fewer than before: the node was restarted
      timing.lost.push_back(lost >= lost_before ? lost - lost_before : lost);
    }
  }

  std::span<const cluster::Membership::Node> nodes() const { return membership_.nodes(); }

 private:
  static std::vector<std::string> names(std::uint32_t count) {
    std::vector<std::string> names;
    names.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) names.push_back(std::to_string(i));
    return names;
  }
  void take(ClusterTiming* timing) {
    while (const auto answer = link_.answer()) {
      membership_.answer(answer->ready, answer->came_ns);
      if (timing != nullptr && answer->ready.header.node < plan_.nodes) {
        times_.answer(answer->ready, answer->came_ns, *timing);
      }
    }
  }

  cluster::MasterLink& link_;
  ClusterTimingPlan plan_;
  const core::Clock& clock_;
  cluster::Membership membership_;
  SwapTimes times_;
  std::uint64_t number_ = 0;
};

}  // namespace

core::Result<ClusterTiming> time_cluster(const cluster::ClusterNetwork& network, const ClusterTimingPlan& plan,
                                         const core::Clock& clock) {
  const std::byte no_model{1};
  auto link = cluster::MasterLink::open(network, std::span(&no_model, 1), 0, clock);
  if (!link) return tl::unexpected(link.error());
  TimedMaster master(**link, plan, clock);
  const std::int64_t until_ns = clock.now_ns() + kComeNs;
  while (!master.frame(nullptr)) {
    if (clock.now_ns() > until_ns) {
      return core::failure(core::ErrorCategory::Failed,
                           fmt::format("not all of {} nodes answered within 20 s on {}, domain {}", plan.nodes,
                                       network.interface_address, network.domain));
    }
  }
  for (int i = 0; i < kFramesToJoin && !core::interrupted(); ++i) master.frame(nullptr);
  ClusterTiming timing;
  timing.frames = plan.frames;
  const std::vector<cluster::Membership::Node> before(master.nodes().begin(), master.nodes().end());
  const double cpu_before_s = process_cpu_s();
  const std::int64_t begun_ns = clock.now_ns();
  for (std::uint32_t i = 0; i < plan.frames && !core::interrupted(); ++i) master.frame(&timing);
  timing.cpu_share = (process_cpu_s() - cpu_before_s) / core::seconds(clock.now_ns() - begun_ns);
  master.finish(timing, before);
  timing.resent_bytes = (*link)->resent_bytes();
  return timing;
}

core::Result<void> answer_frames(const cluster::ClusterNetwork& network, std::uint32_t node, int patience_ms,
                                 const core::Clock& clock) {
  auto link = cluster::NodeLink::open(network, clock);
  if (!link) return tl::unexpected(link.error());
  cluster::ReadyMessage ready{.state = cluster::NodeState::Drawing};
  std::uint64_t next_record = 0;
  std::optional<std::int64_t> heard_ns;
  const std::int64_t patience_ns = std::int64_t{patience_ms} * 1'000'000;
  while (!core::interrupted() && (!heard_ns || clock.now_ns() - *heard_ns < patience_ns)) {
    while (const auto record = (*link)->record()) {
      if (next_record != 0 && record->number > next_record) ready.lost_records += record->number - next_record;
      next_record = record->number + 1;
    }
    const auto came = (*link)->frame();
    if (!came) {
      (*link)->wait(50);
      continue;
    }
    heard_ns = came->came_ns;
    std::this_thread::sleep_for(kDrawing);
    ready.header = came->frame.header;
    ready.header.node = node;
    ready.frame_sent_ns = came->frame.sent_ns;
    ready.frame_came_ns = came->came_ns;
    (*link)->answer(ready);
    const std::pair wanted(came->frame.header.session, came->frame.header.number);
    while ((*link)->swapped() < wanted && clock.now_ns() - *heard_ns < 150'000'000) (*link)->wait(5);
    ready.swapped_ns = (*link)->swapped() == wanted ? clock.now_ns() : 0;
  }
  return {};
}

}  // namespace afm::app
