// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>

#include "device/vulkan.h"
#include "panels/painted_shapes.h"
#include "passes/pixel_area.h"

namespace afm::render {

// A rectangle of a panel, whose lower left corner is 0, 0 and whose upper right one is 1, 1.
struct PanelPart {
  glm::dvec2 low{0.0}, high{1.0};

  bool operator==(const PanelPart&) const = default;
};

// A rectangle of a canvas of `canvas_texels` on a texture of `extent`: in whole texels, with those beside it that
// filtering reaches.
PanelPart part_of(const CanvasBox& changed, const glm::vec2& canvas_texels, vk::Extent2D extent);

// The texels of a part, y down.
PixelBox texels_of(const PanelPart& part, vk::Extent2D extent);

}  // namespace afm::render
