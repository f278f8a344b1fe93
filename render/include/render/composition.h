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

  // Keystone of a projector: maps a point on the output to the point it shows in each eye's image, both in unit
  // coordinates from the top left corner. Points outside the image are black.
  glm::dmat3 picture_from_output{1.0};

  // Mesh of a curved screen, used instead of a keystone and followed by blending with the outputs of overlapping
  // screens; null for a flat screen. Never changed, and shared because pictures still being drawn outlive the settings
  // of a window.
  std::shared_ptr<const scene::WarpMesh> warp{};
  std::shared_ptr<const scene::Blend> blend{};
  bool mesh_lines = false;  // draws the lines of the mesh, for setting up

  bool operator==(const Composition&) const = default;
};

// Area of a composed picture to read: its size, and the screen position of its first pixel, which determines the phase
// of interleaving.
struct ReadArea {
  glm::uvec2 size_px{0};  // 0 x 0: one pixel per pixel of an eye image
  glm::ivec2 screen_px{0};
};

}  // namespace afm::render
