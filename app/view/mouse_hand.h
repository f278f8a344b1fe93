// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render/window.h"
#include "scene/shared/shared_blocks.h"

namespace afm::app {

// A mouse in place of a haptic device. The mouse moves the aim of the servo's simulated hand, along the sample's normal
// and sideways over it. The hand hangs on that aim by its grip, so that the tip snaps in, sticks and flies off by
// itself while the mouse moves evenly (pseudo-haptics). Positions are the hand's, relative to the contact point,
// metres.
//
// Held right button or kGripKey: the aim follows the cursor, up and down or, in a scan, over the sample. Held kOverKey:
// over the sample. Wheel: steps up and down. Middle button or kTurnOnKey: Turn-On.
class MouseHand {
 public:
  static constexpr double kLowestM = -0.030;
  static constexpr double kHighestM = 0.070;
  static constexpr double kRestM = 0.060;       // initial height of the simulated hand
  static constexpr double kWidestM = 0.070;     // largest sideways distance: edge of a sample at the scale that fits it
  static constexpr double kOnSampleM = -0.002;  // height to which a scanning hand lowers the tip

  static constexpr render::Key kGripKey = render::Key::Space;
  static constexpr render::Key kOverKey = render::Key::Z;
  static constexpr render::Key kTurnOnKey = render::Key::T;

  // The sample's outward normal and its x axis, to the right; unit vectors in the device's frame.
  MouseHand(const glm::dvec3& normal, const glm::dvec3& right) : normal_(normal), right_(right) {}

  // `m_per_px`: distance of the aim per pixel of the cursor.
  void apply(const render::WindowEvent& event, double m_per_px, std::int64_t now_ns);

  // Call once a frame. Moves the aim towards the requested position, no faster than the servo accepts, on a path that
  // lasts until the next frame: `frame_s`.
  void update(const glm::dvec2& cursor_px, double m_per_px, double frame_s, std::int64_t now_ns);

  // Lifts the aim off the sample and moves it above the contact point.
  void lift() { wanted_m_ = {0.0, kHighestM, 0.0}; }

  // Starts or stops scanning: a scanning hand lowers its tip onto the sample and follows drags; stopping lifts it.
  void scan(bool on) {
    scanning_ = on;
    wanted_m_ = {0.0, on ? kOnSampleM : kHighestM, 0.0};
  }

  // Lets the hand be led: its aim follows its position. Device frame.
  void rest_at(const glm::dvec3& place_m);

  // Sets new axes, as in the constructor, after the sample was rotated.
  void set_axes(const glm::dvec3& normal, const glm::dvec3& right);

  bool dragging() const { return grips_ > 0; }
  double wanted_m() const { return wanted_m_.y; }
  double aim_m() const { return aim_m_.y; }
  const scene::HandScript& script() const { return script_; }

 private:
  void drag_to(const glm::dvec2& cursor_px, double m_per_px);
  glm::dvec3 away() const;  // the sample's y axis

  glm::dvec3 normal_;
  glm::dvec3 right_;
  // axes: right, up along the normal, and away from the viewer over the sample
  glm::dvec3 wanted_m_{0.0, kRestM, 0.0};
  glm::dvec3 aim_m_{0.0, kRestM, 0.0};
  bool scanning_ = false;
  bool over_held_ = false;
  int grips_ = 0;  // number of held grips among right button, kGripKey and kOverKey
  glm::dvec2 grip_px_{0.0};
  bool axes_changed_ = false;
  bool turn_on_held_ = false;
  std::int64_t turn_on_until_ns_ = 0;
  scene::HandScript script_;
};

}  // namespace afm::app
