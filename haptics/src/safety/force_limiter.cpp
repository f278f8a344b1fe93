// SPDX-License-Identifier: Apache-2.0
#include "haptics/force_limiter.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/check.h"

namespace afm::haptics {

using scene::FaultCode;

namespace {

bool finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Finite `v`, shortened to `longest` if it is longer, with the same direction. Scales first, so that huge numbers do
// not overflow.
glm::dvec3 shortened(const glm::dvec3& v, double longest) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (largest == 0.0) return v;
  const glm::dvec3 direction = v / largest;
  const double length = glm::length(direction);
  return largest * length <= longest ? v : direction * (longest / length);
}

// Clamps to the range; NaN is kept, and cuts the force.
double within(double number, double least, double most) { return number < least ? least : std::min(number, most); }

}  // namespace

ForceLimiter::ForceLimiter(double cap_n, double slew_n_per_s, const WorkspaceStop& stop)
    : cap_n_(std::min(cap_n, kHardCapN)), slew_n_per_s_(slew_n_per_s), stop_(stop) {
  AFM_CHECK(cap_n > 0 && slew_n_per_s > 0 && std::isfinite(slew_n_per_s));
}

FaultCode ForceLimiter::step(const OutputRequest& request) noexcept {
  const double arm_gain = within(request.arm_gain, 0.0, 1.0);
  const glm::dvec3 law_n = arm_gain * within(request.thermal_gain, 0.0, 1.0) * request.law_force_n;
  const glm::dvec3 damping_n =
      -arm_gain * within(request.damping_n_s_per_m, 0.0, kMostDampingNSPerM) * request.velocity_m_per_s;
  const glm::dvec3 target_n =
      law_n + damping_n + arm_gain * stop_.force_n(request.position_m, request.velocity_m_per_s);
  const double largest_step_n = within(request.slew_n_per_s, 0.0, slew_n_per_s_) * request.elapsed_s;
  // also catches overflow on the way here
  if (!finite(target_n) || !finite(request.position_m) || !std::isfinite(largest_step_n) || largest_step_n < 0.0) {
    cut();
    return FaultCode::NotFinite;
  }

  wanted_n_ = law_n + arm_gain * stop_.spring_n(request.position_m);
  const glm::dvec3 clamped_n = shortened(target_n, cap_n_);
  // every vector between two within the cap is within the cap
  command_n_ += shortened(clamped_n - command_n_, largest_step_n);
  if (request.too_fast) {
    cut();
    return FaultCode::VelocityTrip;
  }
  return FaultCode::None;
}

void ForceLimiter::cut() noexcept { wanted_n_ = command_n_ = glm::dvec3(0.0); }

}  // namespace afm::haptics
