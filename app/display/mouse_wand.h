// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "input/wand.h"
#include "render/composition.h"
#include "render/presenter.h"
#include "scene/display/wall.h"

namespace afm::app {

// Projection of the wall into a window.
struct WallPicture {
  render::PicturePlace place;  // place of the composed picture in the window
  render::Composition composition;
  std::array<scene::EyeView, 2> eyes;  // views of the left and the right picture
  scene::Screen screen;                // screen filled by the picture
};

// The mouse as a wand. The wand points at the object behind the cursor, for the eye whose picture the cursor is on, or
// for the middle of the eyes if both share the picture. It is drawn resting at its grip and turned to that object.
// Const; room frame, metres.
class MouseWand {
 public:
  // `stage` defines the plane of wall_point().
  MouseWand(const scene::Screen& stage, const glm::dvec3& grip_m) : stage_(stage), grip_m_(grip_m) {}

  // Ray from the eye through the cursor, in pixels of the window; extrapolated beyond the picture's border.
  input::Ray ray(const WallPicture& picture, const glm::dvec2& cursor_px) const;

  // The wand to draw, turned to `target_m`.
  input::WandState towards(const glm::dvec3& target_m, std::int64_t now_ns) const;

  // Intersection of the ray with the wall's plane.
  glm::dvec3 wall_point(const input::Ray& ray) const;

 private:
  scene::Screen stage_;
  glm::dvec3 grip_m_;
};

}  // namespace afm::app
