// SPDX-License-Identifier: Apache-2.0
#include "app/display/view_headset.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <utility>

#include "core/log.h"
#include "exhibit/frame/exhibit_setup.h"

namespace afm::app {

namespace {

using Turn = render::Headset::Turn;

constexpr double kRestingHalfWidth = 1.0;  // tangent of half the horizontal view from the sweet spot
constexpr double kLevelNormal = 0.1;       // smallest horizontal part of the normal of an upright screen
constexpr double kUnusedFarM = 100.0;      // far plane for an unlimited projection

MirroredEye mirrored(const scene::HeadPose& left, const scene::FieldOfView& fov,
                     const std::array<scene::EyeView, 2>& eyes, double wall_m) {
  return {.eyes = eyes, .screen = scene::screen_of_fov(left, fov, wall_m)};
}

// Places both eyes in the middle while nobody wears the headset.
MirroredEye resting_eyes(const scene::HeadPose& head, glm::uvec2 eye_px, double wall_m) {
  const double half_height = kRestingHalfWidth * static_cast<double>(eye_px.y) / static_cast<double>(eye_px.x);
  const scene::FieldOfView fov{.left_rad = -std::atan(kRestingHalfWidth),
                               .right_rad = std::atan(kRestingHalfWidth),
                               .down_rad = -std::atan(half_height),
                               .up_rad = std::atan(half_height)};
  const auto eye =
      scene::eye_from_fov(head, fov, scene::DepthConvention::VulkanReversedInfinite, scene::kNearM, kUnusedFarM);
  return mirrored(head, fov, {eye.value(), eye.value()}, wall_m);
}

}  // namespace

scene::HeadPose room_from_headset_floor(const scene::Wall& wall, const scene::Screen& screen) {
  const glm::dvec3 viewer = wall.viewers.front().sweet_spot.position_m;
  glm::dvec3 ahead = -screen.normal();
  // a person looking down at a table faces its far edge
  if (std::hypot(ahead.x, ahead.z) < kLevelNormal) ahead = screen.upper_left - screen.lower_left;
  return {.position_m = {viewer.x, scene::floor_height_m(wall), viewer.z},
          .room_from_head = glm::angleAxis(std::atan2(-ahead.x, -ahead.z), glm::dvec3(0.0, 1.0, 0.0))};
}

ViewHeadset::ViewHeadset(const exhibit::Stage& stage, const render::HeadsetRuntime& runtime, const core::Clock& clock)
    : clock_(clock),
      wall_m_(std::max(scene::kNearM,
                       glm::distance(stage.wall.viewers.front().sweet_spot.position_m, stage.screen.center()))),
      room_from_floor_(room_from_headset_floor(stage.wall, stage.screen)),
      head_{.position_m = stage.wall.viewers.front().sweet_spot.position_m,
            .room_from_head = room_from_floor_.room_from_head},
      resting_(resting_eyes(head_, runtime.eye_px(), wall_m_)) {}

core::Result<std::unique_ptr<ViewHeadset>> ViewHeadset::begin(const exhibit::Stage& stage,
                                                              render::HeadsetRuntime& runtime, render::Context& context,
                                                              render::Renderer& renderer, const core::Clock& clock) {
  std::unique_ptr<ViewHeadset> view(new ViewHeadset(stage, runtime, clock));
  auto headset = render::Headset::create(runtime, context, renderer, view->room_from_floor_, clock);
  if (!headset) return tl::unexpected(headset.error());
  view->headset_ = std::move(*headset);
  view->log_messages();
  return view;
}

void ViewHeadset::log_messages() {
  for (const std::string& line : headset_->take_messages()) core::log_line(line);
}

void ViewHeadset::follow(const std::function<void()>& while_waiting) {
  const Turn before = std::exchange(turn_, headset_->next_turn(while_waiting));
  if (!wants_picture()) {
    note_unseen();
    picture_age_.unseen();
  }
  log_messages();
  if (before != turn_) log_turn(before);
}

void ViewHeadset::note_unseen() {
  if (!unseen_since_ns_) unseen_since_ns_ = clock_.now_ns();
}

// Logs changes within the same session state; headset_ itself reports changes of the state.
void ViewHeadset::log_turn(render::Headset::Turn before) const {
  if (turn_ == Turn::Hidden && before == Turn::Frame)
    core::log_line("headset: hidden: its runtime shows something else, or nothing");
  if (turn_ == Turn::Frozen) core::log_line("headset: frozen: its runtime has asked for no frame for 250 ms");
  if (turn_ == Turn::Frame) core::log_line("headset: its runtime asks for frames");
}

const char* ViewHeadset::turn_word() const {
  switch (turn_) {
    case Turn::Off:
      return "off";
    case Turn::Frozen:
      return "frozen";
    case Turn::Hidden:
      return "hidden";
    case Turn::Frame:
      return unseen_since_ns_ ? "hidden" : "shown";
  }
  return "";
}

std::optional<double> ViewHeadset::pose_age_s() const {
  const auto age_ns = headset_->pose_age_ns();
  if (!wants_picture() || unseen_since_ns_ || !age_ns) return std::nullopt;
  return 1e-9 * static_cast<double>(*age_ns);
}

MirroredEye ViewHeadset::locate_eyes(const std::function<void()>& while_waiting) {
  if (!wants_picture()) return resting_;
  note_unseen();  // blind until the picture is shown, as the runtime may provide no image
  const auto eyes = headset_->locate_eyes(while_waiting);
  if (!eyes) return resting_;
  const auto& [left, right] = *eyes;
  head_ = {.position_m = 0.5 * (left.pose.position_m + right.pose.position_m),
           .room_from_head = glm::slerp(left.pose.room_from_head, right.pose.room_from_head, 0.5)};
  return mirrored(left.pose, left.fov, {left.view, right.view}, wall_m_);
}

void ViewHeadset::show() {
  if (!headset_->show()) return picture_age_.unseen();
  unseen_since_ns_.reset();
  picture_age_.shown(clock_.now_ns());
}

bool ViewHeadset::blind(std::int64_t now_ns) const {
  if (turn_ == Turn::Off || turn_ == Turn::Frozen) return true;
  const bool unseen = unseen_since_ns_ && now_ns - *unseen_since_ns_ >= render::Headset::kFrozenNs;
  return unseen || picture_age_.stands_still(now_ns);
}

std::optional<input::WandState> ViewHeadset::wand(std::int64_t now_ns) const {
  using input::WandButton;
  const render::HeadsetController& held = headset_->controller();
  if (!held.connected) return std::nullopt;
  input::WandState wand{.time_ns = now_ns,
                        .position_m = held.position_m,
                        .room_from_wand = held.room_from_controller,
                        .orientation_valid = held.place_valid,
                        .position_valid = held.place_valid,
                        .connected = true};
  const auto set = [&](bool pressed, WandButton button) {
    if (pressed) wand.buttons |= input::bit(button);
  };
  set(held.select, WandButton::Select);
  set(held.grab, WandButton::Grab);
  set(held.scale, WandButton::Scale);
  set(held.home, WandButton::Home);
  wand.push = room_from_floor_.room_from_head * glm::dvec3(held.fly.x, 0.0, -held.fly.y);
  return wand;
}

}  // namespace afm::app
