// SPDX-License-Identifier: Apache-2.0
#include "panels/panel_part.h"

#include <glm/common.hpp>

namespace afm::render {

PanelPart part_of(const CanvasBox& changed, const glm::vec2& canvas_texels, vk::Extent2D extent) {
  const glm::dvec2 size(extent.width, extent.height);
  const glm::dvec2 scale = size / glm::dvec2(canvas_texels);
  const glm::dvec2 low = glm::clamp(glm::floor(scale * glm::dvec2(changed.low)) - 2.0, glm::dvec2(0.0), size);
  const glm::dvec2 high = glm::clamp(glm::ceil(scale * glm::dvec2(changed.high)) + 2.0, glm::dvec2(0.0), size);
  return {.low = {low.x / size.x, 1.0 - high.y / size.y}, .high = {high.x / size.x, 1.0 - low.y / size.y}};
}

PixelBox texels_of(const PanelPart& part, vk::Extent2D extent) {
  const glm::dvec2 size(extent.width, extent.height);
  const glm::ivec2 low(glm::round(glm::dvec2(part.low.x, 1.0 - part.high.y) * size));
  const glm::ivec2 high(glm::round(glm::dvec2(part.high.x, 1.0 - part.low.y) * size));
  return {low, high};
}

}  // namespace afm::render
