// SPDX-License-Identifier: Apache-2.0
#include "input/simulated_wand.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/clock.h"

namespace afm::input {

namespace {

// Physiological tremor of a steady person's pointing hand, 8 to 12 Hz (research, powerwall.md section 4.4).
constexpr double kTremorRad = 0.0015;
constexpr double kTremorHz = 9.0;
constexpr double kTwoPi = 2.0 * 3.14159265358979323846;

std::int64_t later(std::int64_t now_ns, double duration_s) {
  return now_ns + static_cast<std::int64_t>(duration_s * 1e9);
}

// Flash and Hogan (1985): position along the minimum-jerk path, for 0 <= t <= 1.
double minimum_jerk(double t) { return t * t * t * (10.0 + t * (-15.0 + 6.0 * t)); }

glm::dquat looking_along(const glm::dvec3& direction) {
  const glm::dvec3 z = -glm::normalize(direction);
  const glm::dvec3 reference = std::abs(z.y) < 0.99 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(reference, z));
  return glm::dquat(glm::dmat3(x, glm::cross(z, x), z));
}

}  // namespace

SimulatedWand::SimulatedWand(const glm::dvec3& grip_m) : grip_m_(grip_m) {}

void SimulatedWand::aim_at(const glm::dvec3& point_m, double duration_s, std::int64_t now_ns) {
  from_direction_ = aim_direction(now_ns);
  to_direction_ = glm::normalize(point_m - grip_m_);
  aim_start_ns_ = now_ns;
  aim_end_ns_ = later(now_ns, duration_s);
}

void SimulatedWand::press(double duration_s, std::int64_t now_ns) {
  press_start_ns_ = now_ns;
  press_end_ns_ = later(now_ns, duration_s);
}

bool SimulatedWand::arrived(std::int64_t now_ns) const { return now_ns >= aim_end_ns_; }

glm::dvec3 SimulatedWand::aim_direction(std::int64_t now_ns) const {
  if (now_ns >= aim_end_ns_) return to_direction_;
  const double t = static_cast<double>(now_ns - aim_start_ns_) / static_cast<double>(aim_end_ns_ - aim_start_ns_);
  return glm::normalize(glm::mix(from_direction_, to_direction_, minimum_jerk(std::clamp(t, 0.0, 1.0))));
}

WandState SimulatedWand::state(std::int64_t now_ns) const {
  const double phase = kTwoPi * kTremorHz * core::seconds(now_ns - aim_start_ns_);
  const glm::dvec3 tremor(kTremorRad * std::sin(phase), kTremorRad * std::cos(1.17 * phase), 0.0);
  WandState state;
  state.time_ns = now_ns;
  state.position_m = grip_m_;
  state.room_from_wand = looking_along(aim_direction(now_ns) + tremor);
  state.orientation_valid = true;
  state.position_valid = true;
  state.connected = true;
  if (now_ns >= press_start_ns_ && now_ns < press_end_ns_) state.buttons = bit(WandButton::Select);
  return state;
}

}  // namespace afm::input
