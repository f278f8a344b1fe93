// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "input/head_tracker.h"
#include "scene/display/wall.h"

namespace afm::input {

// The viewer's head in the live window: the tracked position, predicted over the measured latency from a packet to its
// picture. Main thread only.
class ViewHead {
 public:
  // The wall must outlive it.
  explicit ViewHead(const scene::Wall& wall) : wall_(wall), tracker_(wall.viewers.front().sweet_spot) {}

  // Call once a frame, with the newest pose and its arrival time if there is one. Empty until a head has been tracked.
  // An impossible place of the head is logged and counts as lost.
  std::optional<scene::HeadPose> update(const std::optional<scene::HeadPose>& pose, std::int64_t pose_ns,
                                        std::int64_t now_ns);

  // Call when the frame of the last update() has been presented. If it was the first with its pose, returns the seconds
  // since the pose arrived. Logs the latencies once a minute.
  std::optional<double> presented(std::int64_t now_ns);

  // Logs the latencies since the last such line.
  void log_latency();

 private:
  bool believed(const scene::HeadPose& pose);

  const scene::Wall& wall_;
  HeadTracker tracker_;
  bool doubted_ = false;
  bool tracked_ = false;
  std::int64_t cause_ns_ = 0;    // arrival time of this frame's pose
  std::int64_t counted_ns_ = 0;  // arrival time of the pose counted last
  double latency_s_ = 0.03;      // smoothed latency; initially a guess of two frames
  std::vector<double> latencies_ms_;
};

}  // namespace afm::input
