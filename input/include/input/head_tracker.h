// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "scene/display/wall.h"

namespace afm::input {

// Head position for the picture, from a tracker that has latency and may lose the head. Pure; one thread.
//
// - Predicts the head's position over the measured latency from its measured velocity, by at most 50 mm. Does not
//   smooth it: on a wall, lag is worse than noise.
// - Holds a lost head for 250 ms, then moves it within 1 s to the sweet spot. A head found again is moved back as
//   gently: the picture never jumps.
class HeadTracker {
 public:
  explicit HeadTracker(const scene::HeadPose& sweet_spot) : sweet_spot_(sweet_spot), shown_(sweet_spot) {}

  // Adds a pose received at `time_ns`; of several with the same time, the first counts.
  void add(const scene::HeadPose& head, std::int64_t time_ns);

  // Head position at the time when a frame drawn now is seen, `latency_s` after its cause. Times never decrease.
  scene::HeadPose head(std::int64_t now_ns, double latency_s);

  static constexpr std::int64_t kHoldNs = 250'000'000;
  static constexpr double kEaseS = 1.0;
  static constexpr double kLongestPredictionS = 0.1;
  static constexpr double kFarthestPredictionM = 0.05;

 private:
  scene::HeadPose sweet_spot_;
  scene::HeadPose target_;  // head position last predicted
  scene::HeadPose shown_;
  std::optional<scene::HeadPose> newest_;
  glm::dvec3 velocity_m_per_s_{0.0};
  std::int64_t newest_ns_ = 0;
  std::int64_t shown_ns_ = 0;
  double tracked_share_ = 0.0;  // share of tracking, from 0 at the sweet spot to 1 at the tracked position
};

}  // namespace afm::input
