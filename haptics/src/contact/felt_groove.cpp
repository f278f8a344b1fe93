// SPDX-License-Identifier: Apache-2.0
#include "haptics/felt_groove.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "haptics/scaling.h"

namespace afm::haptics {

namespace {

// Quintic step from 0 to 1, twice differentiable, and its slope.
struct Step {
  double value = 0, slope = 0;
};
Step quintic_step(double t) {
  if (t <= 0.0) return {};
  if (t >= 1.0) return {.value = 1.0, .slope = 0.0};
  const double rest = 1.0 - t;
  return {.value = t * t * t * (10.0 + t * (6.0 * t - 15.0)), .slope = 30.0 * t * t * rest * rest};
}

}  // namespace

GrooveLimits groove_limits(const DeviceSpec& device) {
  const double stands_n_per_m = std::min(Scaling::kMaxStiffnessNPerM, device.max_stiffness_n_per_m);
  return {.most_force_n = std::min({FeltGroove::kMostForceN, FeltGroove::kShareOfCap * force_cap_n(device),
                                    kUsableLimitShare * device.max_continuous_force_n}),
          .most_stiffness_n_per_m = FeltGroove::kShareOfStiffness * stands_n_per_m};
}

FeltGroove::FeltGroove(const GrooveLimits& limits, double hand_m_per_m) : hand_m_per_m_(hand_m_per_m) {
  if (!(limits.most_force_n > 0.0 && limits.most_stiffness_n_per_m > 0.0)) return;
  half_width_m_ = kCurvature * kDepth * limits.most_force_n / limits.most_stiffness_n_per_m;
  depth_j_ = kDepth * limits.most_force_n * half_width_m_;
  stiffness_n_per_m_ = limits.most_stiffness_n_per_m;
}

void FeltGroove::drop() noexcept {
  gain_ = 0.0;
  pull_ = {};
}

std::optional<FeltGroove::Line> FeltGroove::wanted_line() const noexcept {
  if (plan_.particle == scene::kNoParticle || plan_.guided == 0 || !(depth_j_ > 0.0)) return std::nullopt;
  const glm::dvec2 from_m(plan_.from_m[0], plan_.from_m[1]), way_m = glm::dvec2(plan_.to_m[0], plan_.to_m[1]) - from_m;
  const double length_m = glm::length(way_m);
  return Line{.from_m = hand_m_per_m_ * from_m, .along = way_m / length_m, .length_m = hand_m_per_m_ * length_m};
}

GroovePull FeltGroove::step(const glm::dvec2& tip_xy_m, bool may_act, double elapsed_s) noexcept {
  const std::optional<Line> wanted = may_act ? wanted_line() : std::nullopt;
  const double before = gain_;
  if (before == 0.0) {
    pull_ = {};
    if (!wanted) return pull_;
    line_ = *wanted;
  }
  const double change = elapsed_s / kFadeS;
  gain_ = wanted == line_ ? std::min(1.0, before + change) : std::max(0.0, before - change);
  const Field field = field_at(hand_m_per_m_ * tip_xy_m);
  pull_ = {.acts = true,
           .force_n = gain_ * field.force_n,
           .stored_j = gain_ * field.stored_j,
           .given_j = (gain_ - before) * field.stored_j,
           .stiffness_n_per_m = gain_ * stiffness_n_per_m_};
  return pull_;
}

// Potential and force at full gain.
FeltGroove::Field FeltGroove::field_at(const glm::dvec2& hand_m) const noexcept {
  const glm::dvec2 across(-line_.along.y, line_.along.x), way_m = hand_m - line_.from_m;
  const double aside = glm::dot(way_m, across) / half_width_m_, rest = 1.0 - aside * aside;
  if (!(rest > 0.0)) return {};
  const double ramp_m = kRampOverWidth * half_width_m_, s_m = glm::dot(way_m, line_.along);
  const Step in = quintic_step((s_m + ramp_m) / ramp_m), out = quintic_step((line_.length_m + ramp_m - s_m) / ramp_m);
  const double well = rest * rest * rest, window = in.value * out.value;
  const double pull_across = -6.0 * aside * rest * rest * window / half_width_m_;
  const double pull_along = well * (in.slope * out.value - in.value * out.slope) / ramp_m;
  return {.stored_j = -depth_j_ * well * window,
          .force_n = depth_j_ * (pull_across * across + pull_along * line_.along)};
}

}  // namespace afm::haptics
