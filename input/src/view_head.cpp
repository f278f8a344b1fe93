// SPDX-License-Identifier: Apache-2.0
#include "input/view_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

#include "core/log.h"

namespace afm::input {

namespace {

constexpr std::size_t kToldAfter = 3600;  // number of frames between two log lines: about a minute
constexpr double kSmoothing = 0.05;
constexpr double kLongestLatencyS = 0.25;  // longest plausible latency; more means that the window was stopped

}  // namespace

bool ViewHead::believed(const scene::HeadPose& pose) {
  const std::string doubt = scene::doubt_of_head(wall_, pose.position_m);
  if (doubt.empty() == doubted_) {
    doubted_ = !doubted_;
    core::log_line(doubted_ ? fmt::format("head: the tracker reports an impossible position, {}; drawing for the sweet "
                                          "spot; check room_from_tracker in the wand file",
                                          doubt)
                            : "head: the tracked position is plausible again");
  }
  return doubt.empty();
}

std::optional<scene::HeadPose> ViewHead::update(const std::optional<scene::HeadPose>& pose, std::int64_t pose_ns,
                                                std::int64_t now_ns) {
  if (pose && believed(*pose)) {
    tracker_.add(*pose, pose_ns);
    tracked_ = true;
    cause_ns_ = pose_ns;
  }
  if (!tracked_) return std::nullopt;
  return tracker_.head(now_ns, latency_s_);
}

std::optional<double> ViewHead::presented(std::int64_t now_ns) {
  if (cause_ns_ == counted_ns_) return std::nullopt;
  counted_ns_ = cause_ns_;
  const double latency_s = static_cast<double>(now_ns - cause_ns_) * 1e-9;
  latencies_ms_.push_back(latency_s * 1e3);
  if (latency_s < kLongestLatencyS) latency_s_ += kSmoothing * (latency_s - latency_s_);
  if (latencies_ms_.size() >= kToldAfter) log_latency();
  return latency_s;
}

void ViewHead::log_latency() {
  if (latencies_ms_.empty()) return;
  std::sort(latencies_ms_.begin(), latencies_ms_.end());
  const auto share = [&](double p) {
    return latencies_ms_[static_cast<std::size_t>(p * static_cast<double>(latencies_ms_.size() - 1))];
  };
  core::log_line(fmt::format(
      "head: latency from packet to presented frame p50 {:.1f} ms, p99 {:.1f} ms, max {:.1f} ms in {} frames",
      share(0.5), share(0.99), latencies_ms_.back(), latencies_ms_.size()));
  latencies_ms_.clear();
}

}  // namespace afm::input
