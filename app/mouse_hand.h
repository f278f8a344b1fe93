// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "render/window.h"
#include "scene/shared_blocks.h"

namespace afm::app {

// A mouse in the place of a haptic device. What it moves is the aim of the servo's simulated hand, along the sample's
// normal: the hand itself hangs on that aim by its grip, so that the tip snaps in, sticks and flies off by itself while
// the mouse goes on evenly (pseudo-haptics). Heights are the hand's, above the contact point, metres.
//
// Held right button or space bar: the aim follows the cursor up and down. Wheel: steps. T or middle button: Turn-On.
class MouseHand {
 public:
  static constexpr double kLowestM = -0.030;
  static constexpr double kHighestM = 0.070;
  static constexpr double kRestM = 0.060;  // where the simulated hand begins

  // `normal`: the sample's outward normal in the device's frame, unit.
  explicit MouseHand(const glm::dvec3& normal) : normal_(normal) {}

  // `m_per_px`: how far the aim goes when the cursor moves by a pixel.
  void take(const render::WindowEvent& event, double m_per_px, std::int64_t now_ns);

  // Once a frame. The aim moves to where it is wanted, no faster than a hand that the servo trusts, in a path that
  // lasts until the next frame: `frame_s`.
  void update(const glm::dvec2& cursor_px, double m_per_px, double frame_s, std::int64_t now_ns);

  void lift() { wanted_m_ = kHighestM; }

  bool dragging() const { return grips_ > 0; }
  double wanted_m() const { return wanted_m_; }
  double aim_m() const { return aim_m_; }
  const scene::HandScript& script() const { return script_; }

 private:
  void drag_to(double cursor_y_px, double m_per_px);

  glm::dvec3 normal_;
  double wanted_m_ = kRestM;
  double aim_m_ = kRestM;
  int grips_ = 0;  // of right button and space bar, how many are held
  double grip_y_px_ = 0;
  bool turn_on_held_ = false;
  std::int64_t turn_on_until_ns_ = 0;
  scene::HandScript script_;
};

}  // namespace afm::app
