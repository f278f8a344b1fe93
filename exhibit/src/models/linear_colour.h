// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec4.hpp>

#include "exhibit/models/height_colours.h"

namespace afm::exhibit {

// Vertex colour: linear light, opaque (IEC 61966-2-1).
glm::vec4 linear_colour(const Srgb& colour);

}  // namespace afm::exhibit
