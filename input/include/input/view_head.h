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

  // Once a frame, with the newest pose and when it came, if there is one. Empty as long as no head has been tracked. A
  // place where no head can be is logged, and counts as a head that is lost.
  std::optional<scene::HeadPose> update(const std::optional<scene::HeadPose>& pose, std::int64_t pose_ns,
                                        std::int64_t now_ns);

  // The frame of the last update() has been presented: how long after its pose came, in seconds, if it was the first to
  // show it. Logs the latencies once a minute.
  std::optional<double> presented(std::int64_t now_ns);

  // Logs the latencies since they were last logged.
  void log_latency();

 private:
  bool believed(const scene::HeadPose& pose);

  const scene::Wall& wall_;
  HeadTracker tracker_;
  bool doubted_ = false;
  bool tracked_ = false;
  std::int64_t cause_ns_ = 0;    // when the pose of this frame came
  std::int64_t counted_ns_ = 0;  // time of the pose counted last
  double latency_s_ = 0.03;      // smoothed; at first a guess of two frames
  std::vector<double> latencies_ms_;
};

}  // namespace afm::input
