// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "scene/display/wall.h"

namespace afm::input {

// Head position for the picture, from a tracker that has latency and may lose the head. Pure; one thread.
//
// - The head's place is predicted over the measured latency by its measured velocity, by 50 mm at most. It is not
//   smoothed: on a wall lag is worse than jitter.
// - Lost, it is held for 250 ms, and then eased within 1 s to the sweet spot. Found again, it is eased back as gently:
//   the picture never jumps.
class HeadTracker {
 public:
  explicit HeadTracker(const scene::HeadPose& sweet_spot) : sweet_spot_(sweet_spot), shown_(sweet_spot) {}

  // A pose that came in at `time_ns`; of several with the same time the first counts.
  void add(const scene::HeadPose& head, std::int64_t time_ns);

  // The head when a frame is seen that is drawn now, `latency_s` after its cause. Times never run backwards.
  scene::HeadPose head(std::int64_t now_ns, double latency_s);

  static constexpr std::int64_t kHoldNs = 250'000'000;
  static constexpr double kEaseS = 1.0;
  static constexpr double kLongestPredictionS = 0.1;
  static constexpr double kFarthestPredictionM = 0.05;

 private:
  scene::HeadPose sweet_spot_;
  scene::HeadPose target_;  // as it was predicted last
  scene::HeadPose shown_;
  std::optional<scene::HeadPose> newest_;
  glm::dvec3 velocity_m_per_s_{0.0};
  std::int64_t newest_ns_ = 0;
  std::int64_t shown_ns_ = 0;
  double tracked_share_ = 0.0;  // 0: at the sweet spot, 1: where the tracker says
};

}  // namespace afm::input
