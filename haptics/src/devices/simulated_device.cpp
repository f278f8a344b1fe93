// SPDX-License-Identifier: Apache-2.0
#include "haptics/simulated_device.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "core/check.h"

namespace afm::haptics {

namespace {

// Path from 0 to 1 with no velocity or acceleration at either end (Flash & Hogan 1985).
double minimum_jerk(double t) { return t * t * t * (10.0 + t * (6.0 * t - 15.0)); }

}  // namespace

SimulatedDevice::SimulatedDevice(const glm::dvec3& start_m, const HandImpedance& hand, const DeviceFlaws& flaws)
    : spec_(omni_like("simulated hand")),
      hand_(hand),
      flaws_(flaws),
      path_from_m_(start_m),
      path_to_m_(start_m),
      aim_m_(start_m),
      position_m_(start_m) {
  spec_.has_own_hand = false;
  spec_.max_vibration_n = kMostVibrationN;
  AFM_CHECK(hand.mass_kg > 0 && hand.damping_n_s_per_m >= 0 &&
            hand.damping_n_s_per_m * hand.damping_n_s_per_m < 4.0 * hand.mass_kg * hand.grip_stiffness_n_per_m);
  AFM_CHECK(flaws.quantum_m >= 0 && flaws.friction_n >= 0 && flaws.delay_ns >= 0 && flaws.delay_ns <= 16'000'000);
  passed_.fill({.time_ns = std::numeric_limits<std::int64_t>::min(), .position_m = start_m});
}

DeviceSample SimulatedDevice::read(std::int64_t now_ns) noexcept {
  if (!started_) time_ns_ = now_ns;
  started_ = true;
  const double seconds = 1e-9 * static_cast<double>(std::max<std::int64_t>(0, now_ns - time_ns_));
  const glm::dvec3 aim_before_m = aim_m_;
  aim_m_ = aim_m(now_ns);
  for (int axis = 0; axis < 3; ++axis) advance(axis, seconds, aim_before_m[axis], aim_m_[axis]);
  time_ns_ = std::max(time_ns_, now_ns);

  if (static_cast<double>(now_ns - path_begin_ns_) >= 1e9 * path_duration_s_) finished_script_ = script_;
  if (next_.revision != script_) begin_next_script();
  return {.position_m = reported_m(now_ns),
          .turn_on = next_.turn_on_pressed != 0,
          .healthy = true,
          .finished_script = finished_script_};
}

glm::dvec3 SimulatedDevice::aim_m(std::int64_t now_ns) const noexcept {
  const double elapsed_s = 1e-9 * static_cast<double>(now_ns - path_begin_ns_);
  if (elapsed_s >= path_duration_s_) return path_to_m_;
  return path_from_m_ + minimum_jerk(std::max(0.0, elapsed_s / path_duration_s_)) * (path_to_m_ - path_from_m_);
}

void SimulatedDevice::begin_next_script() noexcept {
  script_ = next_.revision;
  path_begin_ns_ = time_ns_;
  path_duration_s_ = next_.duration_s;
  path_from_m_ = aim_m_;
  path_to_m_ = glm::dvec3(next_.target_m[0], next_.target_m[1], next_.target_m[2]);
}

// Newest position that is old enough, rounded to the encoder step.
glm::dvec3 SimulatedDevice::reported_m(std::int64_t now_ns) noexcept {
  newest_ = (newest_ + 1) % kPassed;
  passed_[newest_] = {.time_ns = now_ns, .position_m = position_m_};
  std::size_t i = newest_;
  for (std::size_t back = 1; back < kPassed && passed_[i].time_ns > now_ns - flaws_.delay_ns; ++back) {
    i = (newest_ + kPassed - back) % kPassed;
  }
  const glm::dvec3& place_m = passed_[i].position_m;
  return flaws_.quantum_m > 0 ? flaws_.quantum_m * glm::round(place_m / flaws_.quantum_m) : place_m;
}

// Opposes the motion; for a hand at rest, opposes the force that would move it, without exceeding it.
double SimulatedDevice::friction_n(int axis, double aim_m) const noexcept {
  const double speed = velocity_m_per_s_[axis];
  if (speed != 0.0) return -std::copysign(flaws_.friction_n, speed);
  const double moving_n = force_n_[axis] + hand_.grip_stiffness_n_per_m * (aim_m - position_m_[axis]);
  return -std::clamp(moving_n, -flaws_.friction_n, flaws_.friction_n);
}

// The motion is x(t) = lag + aim(t) + y(t), with aim(t) = a + b t, the steady lag F/k - c b/k, and the free oscillation
// y'' + 2 s y' + w^2 y = 0 from the current state.
void SimulatedDevice::advance(int axis, double seconds, double aim_from_m, double aim_to_m) noexcept {
  if (seconds <= 0) return;
  const double aim_speed = (aim_to_m - aim_from_m) / seconds;
  const double rubbing_n = friction_n(axis, aim_to_m);
  const double speed_before = velocity_m_per_s_[axis];
  const double lag = (force_n_[axis] + rubbing_n - hand_.damping_n_s_per_m * aim_speed) / hand_.grip_stiffness_n_per_m;
  const double decay = hand_.damping_n_s_per_m / (2.0 * hand_.mass_kg);
  const double omega = std::sqrt(hand_.grip_stiffness_n_per_m / hand_.mass_kg - decay * decay);

  const double y = position_m_[axis] - aim_from_m - lag;
  const double y_speed = velocity_m_per_s_[axis] - aim_speed;
  const double envelope = std::exp(-decay * seconds);
  const double cosine = std::cos(omega * seconds);
  const double sine = std::sin(omega * seconds);
  const double quadrature = (y_speed + decay * y) / omega;
  const double y_after = envelope * (y * cosine + quadrature * sine);
  const double y_speed_after =
      envelope * ((quadrature * omega - decay * y) * cosine - (y * omega + decay * quadrature) * sine);
  position_m_[axis] = aim_to_m + lag + y_after;
  velocity_m_per_s_[axis] = aim_speed + y_speed_after;
  // friction stops a motion but does not reverse it
  if (flaws_.friction_n > 0 && speed_before * velocity_m_per_s_[axis] < 0.0) velocity_m_per_s_[axis] = 0.0;

  // the mechanical end of the workspace absorbs all momentum
  const double inside = std::clamp(position_m_[axis], spec_.workspace_min_m[axis], spec_.workspace_max_m[axis]);
  if (position_m_[axis] != inside) {
    position_m_[axis] = inside;
    velocity_m_per_s_[axis] = 0.0;
  }
}

}  // namespace afm::haptics
