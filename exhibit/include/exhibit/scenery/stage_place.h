// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "scene/display/wall.h"

namespace afm::exhibit {

// What the scene is composed for: the screen that the viewer faces, or the rectangle around all tiles of its
// plane, and the upright screens that go on around its left and right edges, if there are such.
struct StagePlace {
  scene::Screen main;
  std::optional<scene::Screen> left{}, right{};
  glm::dvec3 viewer_m{0.0};  // between the eyes
  double ipd_m = 0.063;
};

// Of the wall's first viewer at his sweet spot.
StagePlace stage_place(const scene::Wall& wall);

}  // namespace afm::exhibit
