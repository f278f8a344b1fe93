// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "input/wand.h"
#include "render/frame.h"

namespace afm::exhibit {

struct PanelHit {
  glm::dvec3 point_m{0.0};   // point of intersection in the room frame
  glm::dvec2 place_mm{0.0};  // offset from the panel's top left corner, x to the right and y down
};

// Intersection of a ray with a panel, from either side; empty if it misses the panel or the panel has no area.
// `millimetre_m` as in render::RendererOptions.
std::optional<PanelHit> hit_of(const input::Ray& ray, const render::PanelPlacement& panel, double millimetre_m);

// Width and height of a panel in the panel's millimetres.
glm::dvec2 size_mm(const render::PanelPlacement& panel, double millimetre_m);

}  // namespace afm::exhibit
