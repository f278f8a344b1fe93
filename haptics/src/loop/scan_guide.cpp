// SPDX-License-Identifier: Apache-2.0
#include "haptics/scan_guide.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace afm::haptics {

namespace {

// `way`, shortened to `longest` if it is longer.
glm::dvec3 at_most(const glm::dvec3& way, double longest) {
  const double length = glm::length(way);
  return length > longest ? way * (longest / length) : way;
}

}  // namespace

ScanGuide::ScanGuide(const DeviceSpec& device)
    : stiffness_n_per_m_(std::min(kStiffnessNPerM, kShareOfStiffness * device.max_stiffness_n_per_m)),
      most_force_n_(std::min({kMostForceN, force_cap_n(device), kUsableLimitShare * device.max_continuous_force_n})),
      stop_(device.workspace_min_m - device.contact_point_m, device.workspace_max_m - device.contact_point_m) {}

void ScanGuide::reset() noexcept {
  tank_.fill();
  target_.reset();
  leads_ = lost_ = false;
}

ScanGuide::Pull ScanGuide::step(const Input& input) noexcept {
  if (!input.force_on) {
    reset();
    return {};
  }
  tank_.refill(input.elapsed_s);
  if (!input.turn_on) {
    target_.reset();
    leads_ = lost_ = false;
    return {};
  }
  if (!input.target || !is_reached_by(*input.target)) {
    target_.reset();
    lost_ = lost_ || leads_;
    leads_ = false;
    return {};
  }
  target_ = input.target;
  if (lost_) return {};
  if (!leads_) {
    leads_ = true;
    attractor_m_ = input.hand_m;
    led_s_ = 0;
  }
  led_s_ += input.elapsed_s;
  const double before_j = stored_j(input.hand_m);
  move_attractor(input.target->in_device_m, input.hand_m, input.elapsed_s);
  const double stored = stored_j(input.hand_m);
  tank_.take(stored - before_j);
  return {.leads = true,
          .force_n = stiffness_n_per_m_ * (attractor_m_ - input.hand_m),
          .stored_j = stored,
          .given_j = stored - before_j,
          .stiffness_n_per_m = stiffness_n_per_m_};
}

// True if the hand can reach the target, and the path did not jump to it.
bool ScanGuide::is_reached_by(const Target& target) noexcept {
  if (!is_within_reach(target.in_device_m) || stop_.stored_j(target.in_device_m) > 0.0) return false;
  if (!target_ || target_->time_ns == target.time_ns) return true;
  const double seconds = 1e-9 * static_cast<double>(target.time_ns - target_->time_ns);
  return glm::length(target.in_sample_m - target_->in_sample_m) <= kJumpM + kJumpMPerS * std::max(0.0, seconds);
}

double ScanGuide::stored_j(const glm::dvec3& hand_m) const noexcept {
  const glm::dvec3 stretch_m = attractor_m_ - hand_m;
  return 0.5 * stiffness_n_per_m_ * glm::dot(stretch_m, stretch_m);
}

void ScanGuide::move_attractor(const glm::dvec3& target_m, const glm::dvec3& hand_m, double elapsed_s) noexcept {
  const glm::dvec3 before_m = attractor_m_;
  const double before_j = stored_j(hand_m);
  const double share = -std::expm1(-elapsed_s / kLagS);
  attractor_m_ += at_most(share * (target_m - before_m), kFastestMPerS * elapsed_s);
  const double leash_m = most_force_n_ / stiffness_n_per_m_ * std::min(1.0, led_s_ / kRiseS);
  attractor_m_ = hand_m + at_most(attractor_m_ - hand_m, leash_m);
  // stored energy is convex along the path, so a fraction of the path costs at most that fraction of the total
  const double wanted_j = stored_j(hand_m) - before_j;
  if (wanted_j > tank_.held_j()) attractor_m_ = before_m + (tank_.held_j() / wanted_j) * (attractor_m_ - before_m);
}

}  // namespace afm::haptics
