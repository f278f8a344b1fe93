// SPDX-License-Identifier: Apache-2.0
#include "input/navigation.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "input/hid_wand.h"

namespace afm::input {

namespace {

constexpr double kFlyMPerS = 0.6;
constexpr double kTurnRadPerS = 1.2;
constexpr double kDampingS = 0.1;     // time constant of starting and stopping
constexpr double kScaleMetres = 0.3;  // motion of the hand along the ray for a factor of e
constexpr double kScaleRad = 0.35;    // tilt of the wand for a factor of e
constexpr double kScalePerS = 1.0;    // speed at the stop of a cap, in powers of e per second
constexpr double kHeldForceN = 0.05;  // force below the threshold of perception

bool finite(const WandState& wand) {
  const auto& p = wand.position_m;
  const auto& q = wand.room_from_wand;
  return std::isfinite(p.x + p.y + p.z) && std::isfinite(q.x + q.y + q.z + q.w);
}

glm::dvec3 response(const glm::dvec3& deflection) {
  return {rate_response(deflection.x), rate_response(deflection.y), rate_response(deflection.z)};
}

// Exact displacement for a speed that approaches `target` with the time constant kDampingS: any division of the time
// gives the same sum.
glm::dvec3 way_of(glm::dvec3& speed, const glm::dvec3& target, double frame_s) {
  const double rest = std::exp(-frame_s / kDampingS);
  const glm::dvec3 way = target * frame_s + (speed - target) * kDampingS * (1.0 - rest);
  speed = target + (speed - target) * rest;
  return way;
}

double elevation(const glm::dvec3& direction) { return std::asin(std::clamp(direction.y, -1.0, 1.0)); }

}  // namespace

bool navigation_locked(const scene::TipState& tip) {
  const double force_n = glm::length(glm::dvec3(tip.hand.force_n[0], tip.hand.force_n[1], tip.hand.force_n[2]));
  // NaN locks too
  return tip.phase == physics::Phase::Attached || !(force_n <= kHeldForceN);
}

void Navigation::update(const WandState& wand, double frame_s, bool locked) {
  const bool home_pressed = wand.pressed(WandButton::Home);
  const bool go_home = home_pressed && !home_was_pressed_;
  home_was_pressed_ = home_pressed;
  if (locked || !wand.connected || !finite(wand)) {
    let_go();
    return;
  }
  if (go_home) {
    home();
    return;
  }
  const bool pointed = wand.motion == WandMotion::Absolute;
  const bool scales = wand.pressed(WandButton::Scale);
  if (wand.pressed(WandButton::Grab) && !scales && pointed && wand.orientation_valid) {
    follow_grab(wand);
  } else {
    grab_.reset();
  }
  if (scales && (wand.orientation_valid || !pointed)) {
    follow_scale(wand, frame_s);
  } else {
    scaling_.reset();
  }
  if (!scales) fly(wand, frame_s);
}

void Navigation::home() {
  let_go();
  shift_m_ = glm::dvec3(0.0);
  turn_ = glm::dquat(1.0, 0.0, 0.0, 0.0);
  scale_ = 1.0;
}

void Navigation::let_go() {
  grab_.reset();
  scaling_.reset();
  velocity_m_per_s_ = turn_rate_rad_per_s_ = glm::dvec3(0.0);
}

// Vrui's six-degrees-of-freedom dragger: keeps the scene fixed relative to the wand from the moment of grabbing.
void Navigation::follow_grab(const WandState& wand) {
  const glm::dquat& q = wand.room_from_wand;
  if (!grab_) {
    grab_ = Grab{.wand_from_scene = glm::inverse(q) * turn_,
                 .middle_in_wand_m = glm::inverse(q) * (pivot_m_ + shift_m_ - wand.position_m)};
  }
  turn_ = q * grab_->wand_from_scene;
  shift_m_ = wand.position_m + q * grab_->middle_in_wand_m - pivot_m_;
}

void Navigation::follow_scale(const WandState& wand, double frame_s) {
  const glm::dvec3 middle = pivot_m_ + shift_m_;
  if (wand.motion == WandMotion::Rate) {
    scale_about(middle, scale_ * std::exp(kScalePerS * frame_s * rate_response(wand.push.y)), middle);
    return;
  }
  const glm::dvec3 along = ray_of(wand).direction;
  if (!scaling_) scaling_ = Scaling{wand.position_m, along, middle, scale_};
  if (wand.position_valid) {
    const double nearer = -glm::dot(wand.position_m - scaling_->wand_m, scaling_->along);
    scale_about(scaling_->wand_m, scaling_->scale * std::exp(nearer / kScaleMetres), scaling_->middle_m);
  } else {
    const double raised = elevation(along) - elevation(scaling_->along);
    scale_about(middle, scaling_->scale * std::exp(raised / kScaleRad), middle);
  }
}

// Changes the scale about `center_m`; `from_m` is the position of the centre at the scale for which `center_m` is kept.
void Navigation::scale_about(const glm::dvec3& center_m, double scale, const glm::dvec3& from_m) {
  const double before = scaling_ ? scaling_->scale : scale_;
  scale_ = std::clamp(scale, kSmallestScale, kLargestScale);
  shift_m_ = center_m + (scale_ / before) * (from_m - center_m) - pivot_m_;
}

void Navigation::fly(const WandState& wand, double frame_s) {
  const bool pushed = wand.motion == WandMotion::Absolute || wand.pressed(WandButton::Grab);
  const glm::dvec3 velocity = pushed ? kFlyMPerS * response(wand.push) : glm::dvec3(0.0);
  const glm::dvec3 rate = pushed ? kTurnRadPerS * response(wand.turn) : glm::dvec3(0.0);
  shift_m_ += way_of(velocity_m_per_s_, velocity, frame_s);
  const double far = glm::length(shift_m_);
  if (far > kFarthestM && !grab_) shift_m_ *= kFarthestM / far;
  const glm::dvec3 angle = way_of(turn_rate_rad_per_s_, rate, frame_s);
  const double turned = glm::length(angle);
  if (turned > 0.0) turn_ = glm::normalize(glm::angleAxis(turned, angle / turned) * turn_);
}

glm::dmat4 Navigation::room_from_scene() const {
  const glm::dmat3 linear = scale_ * glm::mat3_cast(turn_);
  glm::dmat4 room_from_scene(linear);
  room_from_scene[3] = glm::dvec4(pivot_m_ + shift_m_ - linear * pivot_m_, 1.0);
  return room_from_scene;
}

}  // namespace afm::input
