// SPDX-License-Identifier: Apache-2.0
#include "input/head_tracker.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/clock.h"

namespace afm::input {

namespace {

constexpr double kVelocityMemoryS = 0.03;  // averaging time of the velocity
constexpr double kLongestGapS = 0.1;       // longest gap between two poses that gives a velocity
constexpr double kFastestHeadMPerS = 3.0;  // speed above which the tracker has confused its markers

bool finite(const scene::HeadPose& head) {
  const auto& p = head.position_m;
  const auto& q = head.room_from_head;
  return std::isfinite(p.x + p.y + p.z) && std::abs(glm::length(q) - 1.0) < 1e-3;
}

// Smooth step: starts and ends with zero slope.
double eased(double share) { return share * share * (3.0 - 2.0 * share); }

}  // namespace

void HeadTracker::add(const scene::HeadPose& head, std::int64_t time_ns) {
  if (!finite(head) || (newest_ && time_ns <= newest_ns_)) return;
  const double step_s = newest_ ? core::seconds(time_ns - newest_ns_) : kLongestGapS;
  if (step_s < kLongestGapS) {
    const glm::dvec3 velocity = (head.position_m - newest_->position_m) / step_s;
    const double weight = -std::expm1(-step_s / kVelocityMemoryS);
    if (glm::length(velocity) < kFastestHeadMPerS) velocity_m_per_s_ += weight * (velocity - velocity_m_per_s_);
  } else {
    velocity_m_per_s_ = glm::dvec3(0.0);
  }
  newest_ = head;
  newest_ns_ = time_ns;
}

scene::HeadPose HeadTracker::head(std::int64_t now_ns, double latency_s) {
  const double frame_s = shown_ns_ == 0 ? 0.0 : std::max(0.0, core::seconds(now_ns - shown_ns_));
  shown_ns_ = now_ns;
  if (!newest_) return shown_;
  const bool tracked = now_ns - newest_ns_ <= kHoldNs;
  const double step = frame_s / kEaseS;
  tracked_share_ = std::clamp(tracked_share_ + (tracked ? step : -step), 0.0, 1.0);

  if (tracked) {
    target_ = *newest_;
    const double ahead_s =
        std::clamp(std::max(0.0, core::seconds(now_ns - newest_ns_)) + latency_s, 0.0, kLongestPredictionS);
    glm::dvec3 way = velocity_m_per_s_ * ahead_s;
    const double length = glm::length(way);
    if (length > kFarthestPredictionM) way *= kFarthestPredictionM / length;
    target_.position_m += way;
  }
  const double share = eased(tracked_share_);
  shown_.position_m = glm::mix(sweet_spot_.position_m, target_.position_m, share);
  shown_.room_from_head = glm::slerp(sweet_spot_.room_from_head, target_.room_from_head, share);
  return shown_;
}

}  // namespace afm::input
