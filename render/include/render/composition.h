// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "scene/display/stereo_layout.h"

namespace afm::render {

// Parameters that turn the two eye images into the picture of an output.
struct Composition {
  scene::StereoMode mode = scene::StereoMode::SideBySide;
  scene::EyeOrder order = scene::EyeOrder::Straight;

  // Keystone of a projector: takes a place on the output to the place in each eye's image that it shows, both in unit
  // coordinates from the top left corner. What lies beyond the image is black.
  glm::dmat3 picture_from_output{1.0};

  bool operator==(const Composition&) const = default;
};

// Area of a composed picture to read: its size, and the screen position of its first pixel, which interleaving depends
// on.
struct ReadArea {
  glm::uvec2 size_px{0};  // 0 x 0: one pixel of an eye image is one pixel
  glm::ivec2 screen_px{0};
};

}  // namespace afm::render
