// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/vec4.hpp>
#include <vector>

#include "exhibit/models/height_colours.h"
#include "scene/graph/scene.h"

namespace afm::exhibit {

// Colour of a force from -1, the strongest pull, through 0 to 1, the strongest push: blue, grey, orange, which viewers
// with colour blindness tell apart. Clamps other values.
Srgb force_colour(double share);

inline constexpr std::size_t kSliceColumns = 160, kSliceRows = 48;  // numbers of vertices

// An upright rectangle, unlit and seen from both sides: vertices row by row from below, x from -0.5 to 0.5, z from 0 to
// 1. Node "slice", whose vertices a frame gives.
scene::Scene slice_mesh();

// The colours of forces as an unlit vertical strip 1 high and `width` wide, from the strongest pull at its foot to the
// strongest push; no force is in its middle. Node "bar", whose vertices, those of force_bar_vertices(), a frame gives.
scene::Scene force_bar(double width);
std::vector<scene::Vertex> force_bar_vertices(double width);

inline constexpr std::size_t kSurfaceSide = 128;  // number of vertices on a side

// A translucent surface of kSurfaceSide by kSurfaceSide vertices, row by row from below, seen from both sides: x and y
// from -0.5 to 0.5, z from 0 to 1. Node "surface", whose vertices a frame gives.
scene::Scene equal_force_mesh();

}  // namespace afm::exhibit
