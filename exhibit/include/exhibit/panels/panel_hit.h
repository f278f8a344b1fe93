// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "input/wand.h"
#include "render/frame.h"

namespace afm::exhibit {

struct PanelHit {
  glm::dvec3 point_m{0.0};   // in the room
  glm::dvec2 place_mm{0.0};  // of the panel, from the panel's top left corner, x to the right and y down
};

// The point where a ray meets a panel, from either side; nothing outside it, or if the panel has no area.
// `millimetre_m` as in render::RendererOptions.
std::optional<PanelHit> hit_of(const input::Ray& ray, const render::PanelPlacement& panel, double millimetre_m);

// Width and height of a panel in its millimetres.
glm::dvec2 size_mm(const render::PanelPlacement& panel, double millimetre_m);

}  // namespace afm::exhibit
