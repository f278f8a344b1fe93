// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>

#include "render/frame.h"

namespace afm::app {

// Target of a ray: a control of the open parameter panel, the tab that opens it, or a swatch.
struct Pointed {
  std::optional<render::ControlTarget> control;
  bool tab = false;
  std::optional<std::size_t> swatch;
  glm::dvec3 point_m{0.0};  // target point in the room frame
};

}  // namespace afm::app
