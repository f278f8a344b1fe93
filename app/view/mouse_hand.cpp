// SPDX-License-Identifier: Apache-2.0
#include "app/view/mouse_hand.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace afm::app {

namespace {

constexpr double kFastestMPerS = 0.20;  // mean speed of the aim; the peak is 15/8 of it, the servo's limit 0.8
constexpr double kWheelStepM = 0.002;
constexpr double kLongestPathS = 0.25;
constexpr std::int64_t kShortestPressNs = 150'000'000;  // duration that makes a click between two frames a press

using Kind = render::WindowEvent::Kind;

bool is_of_key(const render::WindowEvent& event) { return event.kind == Kind::KeyDown || event.kind == Kind::KeyUp; }

bool is_over(const render::WindowEvent& event) { return is_of_key(event) && event.key == MouseHand::kOverKey; }

bool is_grip(const render::WindowEvent& event) {
  return is_of_key(event) ? event.key == MouseHand::kGripKey : event.button == render::MouseButton::Right;
}

bool is_turn_on(const render::WindowEvent& event) {
  return is_of_key(event) ? event.key == MouseHand::kTurnOnKey : event.button == render::MouseButton::Middle;
}

}  // namespace

void MouseHand::drag_to(const glm::dvec2& cursor_px, double m_per_px) {
  const glm::dvec2 moved_m = m_per_px * glm::dvec2(cursor_px.x - grip_px_.x, grip_px_.y - cursor_px.y);
  wanted_m_ += scanning_ || over_held_ ? glm::dvec3(moved_m.x, 0.0, moved_m.y) : glm::dvec3(moved_m, 0.0);
  wanted_m_ =
      glm::clamp(wanted_m_, glm::dvec3(-kWidestM, kLowestM, -kWidestM), glm::dvec3(kWidestM, kHighestM, kWidestM));
  grip_px_ = cursor_px;
}

void MouseHand::set_axes(const glm::dvec3& normal, const glm::dvec3& right) {
  axes_changed_ = axes_changed_ || normal != normal_ || right != right_;
  normal_ = normal;
  right_ = right;
}

glm::dvec3 MouseHand::away() const { return glm::cross(normal_, right_); }

void MouseHand::rest_at(const glm::dvec3& place_m) {
  wanted_m_ = {glm::dot(place_m, right_), glm::dot(place_m, normal_), glm::dot(place_m, away())};
}

void MouseHand::apply(const render::WindowEvent& event, double m_per_px, std::int64_t now_ns) {
  if (event.kind == Kind::Scroll) {
    wanted_m_.y = std::clamp(wanted_m_.y + kWheelStepM * event.scroll, kLowestM, kHighestM);
    return;
  }
  const bool down = event.kind == Kind::KeyDown || event.kind == Kind::ButtonDown;
  if (is_grip(event) || is_over(event)) {
    if (dragging()) drag_to(event.cursor_px, m_per_px);
    grip_px_ = event.cursor_px;
    grips_ = std::clamp(grips_ + (down ? 1 : -1), 0, 3);
    if (is_over(event)) over_held_ = down;
  }
  if (is_turn_on(event)) {
    turn_on_held_ = down;
    if (down) turn_on_until_ns_ = now_ns + kShortestPressNs;
  }
}

void MouseHand::update(const glm::dvec2& cursor_px, double m_per_px, double frame_s, std::int64_t now_ns) {
  if (dragging()) drag_to(cursor_px, m_per_px);
  script_.turn_on_pressed = turn_on_held_ || now_ns < turn_on_until_ns_ ? 1 : 0;

  const double seconds = std::clamp(frame_s, 0.001, kLongestPathS);
  const double reach = kFastestMPerS * seconds;
  const glm::dvec3 way = wanted_m_ - aim_m_;
  const double length = glm::length(way);
  const glm::dvec3 next = length > reach ? aim_m_ + reach / length * way : wanted_m_;
  if (next == aim_m_ && script_.revision != 0 && !axes_changed_) return;
  aim_m_ = next;
  axes_changed_ = false;
  const glm::dvec3 target = aim_m_.x * right_ + aim_m_.y * normal_ + aim_m_.z * away();
  script_.target_m = {target.x, target.y, target.z};
  script_.duration_s = seconds;
  ++script_.revision;
}

}  // namespace afm::app
