// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <memory>

#include "scene/display/blend.h"
#include "scene/display/stereo_layout.h"
#include "scene/display/warp_mesh.h"

namespace afm::render {

// Parameters that turn the two eye images into the picture of an output.
struct Composition {
  scene::StereoMode mode = scene::StereoMode::SideBySide;
  scene::EyeOrder order = scene::EyeOrder::Straight;

  // Keystone of a projector: takes a place on the output to the place in each eye's image that it shows, both in unit
  // coordinates from the top left corner. What lies beyond the image is black.
  glm::dmat3 picture_from_output{1.0};

  // Instead of a keystone: the mesh of a curved screen. Then blending with the outputs of the screens that overlap this
  // one. Null: none. Shared, since pictures that are still being drawn outlive the settings of a window; never changed.
  std::shared_ptr<const scene::WarpMesh> warp{};
  std::shared_ptr<const scene::Blend> blend{};
  bool mesh_lines = false;  // show the mesh's lines, for setting up

  bool operator==(const Composition&) const = default;
};

// Area of a composed picture to read: its size, and the screen position of its first pixel, which interleaving depends
// on.
struct ReadArea {
  glm::uvec2 size_px{0};  // 0 x 0: one pixel of an eye image is one pixel
  glm::ivec2 screen_px{0};
};

}  // namespace afm::render
