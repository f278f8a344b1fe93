// SPDX-License-Identifier: Apache-2.0
#include "input/hid_wand.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "core/clock.h"

namespace afm::input {

namespace {

constexpr double kSteerRadPerS = 1.0;
constexpr double kLargestYawRad = 1.3;
constexpr double kLargestPitchRad = 1.0;
constexpr double kLongestStepS = 0.1;           // longest step, so that the ray does not jump after a pause
constexpr std::int64_t kTwiceNs = 400'000'000;  // longest time between the presses of a double press
constexpr double kShortestMotionS = 1e-4;
constexpr double kFirstMotionS = 0.01;
constexpr double kDeadZone = 0.1;
constexpr double kSharpness = 2.5;  // exponent of rate_response()

}  // namespace

double rate_response(double deflection) {
  if (!std::isfinite(deflection)) return 0.0;
  const double beyond = std::clamp((std::abs(deflection) - kDeadZone) / (1.0 - kDeadZone), 0.0, 1.0);
  return std::copysign(std::expm1(kSharpness * beyond) / std::expm1(kSharpness), deflection);
}

HidWand::HidWand(std::unique_ptr<HidDriver> driver, const HandPlace& place)
    : driver_(std::move(driver)), place_(place), forward_rad_(std::atan2(-place.forward.x, -place.forward.z)) {
  state_.position_m = place_.position_m;
  state_.connected = true;
  state_.motion = driver_->steered() ? WandMotion::Rate : WandMotion::Absolute;
  state_.orientation_valid = driver_->steered();
}

bool HidWand::take(Bytes report, std::int64_t now_ns) {
  if (driver_->steered()) steer(now_ns);  // steers with the deflection up to now
  const auto input = driver_->read(report);
  if (!input) return false;
  state_.time_ns = now_ns;
  if (input->push) state_.push = *input->push;
  if (input->turn) state_.turn = *input->turn;
  if (input->imu_count > 0) {
    const double since_s = motion_ns_ == 0 ? kFirstMotionS : core::seconds(now_ns - motion_ns_);
    const double each_s = std::clamp(since_s, kShortestMotionS, kLongestStepS) / static_cast<double>(input->imu_count);
    motion_ns_ = now_ns;
    for (std::size_t i = 0; i < input->imu_count; ++i) filter_.add(input->imu[i], each_s, input->has_gyro);
    state_.orientation_valid = filter_.valid();
  }
  if (input->yaw_from_forward_rad) heading_offset_rad_ = *input->yaw_from_forward_rad - filter_.heading_rad();
  if (input->buttons) press(*input->buttons, now_ns);
  return true;
}

void HidWand::press(std::uint32_t buttons, std::int64_t now_ns) {
  const std::uint32_t down = buttons & ~state_.buttons;
  if ((down & bit(WandButton::Stop)) != 0) ++state_.stops;
  const bool grab = (buttons & bit(WandButton::Grab)) != 0;
  if (driver_->steered()) {
    // double press of Grab, because a cap has no button to spare for Home
    if ((down & bit(WandButton::Grab)) != 0 && !home_held_) {
      home_held_ = grabbed_ns_ != 0 && now_ns - grabbed_ns_ < kTwiceNs;
      grabbed_ns_ = home_held_ ? 0 : now_ns;
    }
    home_held_ = home_held_ && grab;
    if (home_held_) buttons = (buttons & ~bit(WandButton::Grab)) | bit(WandButton::Home);
  }
  const std::uint32_t centering = bit(WandButton::Recenter) | (driver_->steered() ? bit(WandButton::Home) : 0U);
  if ((buttons & ~state_.buttons & centering) != 0) recenter();
  state_.buttons = buttons;
}

void HidWand::recenter() {
  yaw_rad_ = pitch_rad_ = 0.0;
  heading_offset_rad_ = -filter_.heading_rad();
}

// Twisting, tilting and shifting the cap all steer, whichever the user tries first.
void HidWand::steer(std::int64_t now_ns) {
  const double step_s = std::clamp(core::seconds(now_ns - steered_ns_), 0.0, kLongestStepS);
  steered_ns_ = now_ns;
  if (state_.pressed(WandButton::Grab) || state_.pressed(WandButton::Scale)) return;
  const double yaw = rate_response(state_.turn.y) - rate_response(state_.turn.z) - rate_response(state_.push.x);
  const double pitch = rate_response(state_.turn.x) + rate_response(state_.push.y);
  const double reach = kSteerRadPerS * step_s;
  yaw_rad_ = std::clamp(yaw_rad_ + reach * std::clamp(yaw, -1.0, 1.0), -kLargestYawRad, kLargestYawRad);
  pitch_rad_ = std::clamp(pitch_rad_ + reach * std::clamp(pitch, -1.0, 1.0), -kLargestPitchRad, kLargestPitchRad);
}

WandState HidWand::state(std::int64_t now_ns) {
  if (driver_->steered()) {
    steer(now_ns);
    state_.room_from_wand =
        glm::angleAxis(forward_rad_ + yaw_rad_, kUp) * glm::angleAxis(pitch_rad_, glm::dvec3(1.0, 0.0, 0.0));
  } else {
    state_.room_from_wand = glm::angleAxis(forward_rad_ + heading_offset_rad_, kUp) * filter_.level_from_wand();
  }
  return state_;
}

}  // namespace afm::input
