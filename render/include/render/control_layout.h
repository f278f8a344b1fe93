// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "render/frame.h"

namespace afm::render {

// A rectangle on a panel: millimetres from its top left corner, x to the right and y down.
struct ControlBox {
  glm::dvec2 from_mm{0.0};
  glm::dvec2 to_mm{0.0};
};

// Position of a target on a control panel of this size, as drawn. The target must belong to the panel.
ControlBox control_box(const ControlPanel& panel, const glm::dvec2& size_mm, const ControlTarget& target);

// The target at a point of the panel, if one is there.
std::optional<ControlTarget> control_at(const ControlPanel& panel, const glm::dvec2& size_mm,
                                        const glm::dvec2& point_mm);

}  // namespace afm::render
