// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "exhibit/models/relief.h"
#include "scene/shared/soft_blocks.h"

namespace afm::exhibit {

// Side of the square of a soft sample for a tip of this radius.
double marks_side_m(double tip_radius_m);

// Marks in a soft sample, kMarkTiles of them, without load: in true proportions, each vertex the mean of 2 x 2 squares.
// Colours are those from an eighth of the tip's radius below the level sample to as much above it, or more if the marks
// need it.
HeightRelief marks_relief(std::span<const scene::MarkTile> tiles, double tip_radius_m);

}  // namespace afm::exhibit
