// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <optional>

#include "render/frame.h"

namespace afm::render {

// Rectangle on a panel, in millimetres from its top left corner, x to the right and y down.
struct ControlBox {
  glm::dvec2 from_mm{0.0};
  glm::dvec2 to_mm{0.0};
};

// Drawn position of a target on a control panel of this size. The target must belong to the panel.
ControlBox control_box(const ControlPanel& panel, const glm::dvec2& size_mm, const ControlTarget& target);

// Place of the panel's picture. The panel must have one.
ControlBox picture_box(const ControlPanel& panel, const glm::dvec2& size_mm);

// Target at a point of the panel, if there is one.
std::optional<ControlTarget> control_at(const ControlPanel& panel, const glm::dvec2& size_mm,
                                        const glm::dvec2& point_mm);

}  // namespace afm::render
