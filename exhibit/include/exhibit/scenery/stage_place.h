// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scene/display/wall.h"

namespace afm::exhibit {

// Screens for which the scene is composed: the one that the viewer faces, or the rectangle around all tiles in its
// plane, and upright screens that continue it at its left and right edges, if there are any.
struct StagePlace {
  scene::Screen main;
  std::optional<scene::Screen> left{}, right{};
  glm::dvec3 viewer_m{0.0};  // midpoint of the eyes
  double ipd_m = 0.063;
};

// Place for the wall's first viewer at the sweet spot.
StagePlace stage_place(const scene::Wall& wall);

}  // namespace afm::exhibit
