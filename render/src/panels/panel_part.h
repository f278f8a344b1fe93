// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>

#include "device/vulkan.h"
#include "drawing/pixel_area.h"
#include "panels/painted_shapes.h"

namespace afm::render {

// Rectangle of a panel; the panel's lower left corner is 0, 0, its upper right one 1, 1.
struct PanelPart {
  glm::dvec2 low{0.0}, high{1.0};

  bool operator==(const PanelPart&) const = default;
};

// Converts a rectangle of a canvas of `canvas_texels` to a part of a texture of `extent`: rounded out to whole texels,
// with the neighbours that filtering reaches.
PanelPart part_of(const CanvasBox& changed, const glm::vec2& canvas_texels, vk::Extent2D extent);

// Texels of a part, y down.
PixelBox texels_of(const PanelPart& part, vk::Extent2D extent);

}  // namespace afm::render
