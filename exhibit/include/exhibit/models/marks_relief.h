// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>

#include "exhibit/models/relief.h"
#include "scene/shared/soft_blocks.h"

namespace afm::scene {
struct ParticleSet;
}

namespace afm::exhibit {

// Square on which the tip of a set leaves marks, and the range of heights for its colours.
struct MarksScale {
  double side_m = 0;
  double colours_m = 0;  // heights from this far below the level sample to as far above, extended if the marks need it
  bool only_up = false;  // true: colours only from the level sample upwards
};

// Scale of a set with a soft sample, an eighth of the tip's radius, or with ink, the thickness of its layer.
MarksScale marks_scale(const scene::ParticleSet& set);

// Height of a square without load, metres from the level sample; column and row count from the smallest x and y, and
// are less than kSoftSide. `tiles` are kMarkTiles.
double mark_height_m(std::span<const scene::MarkTile> tiles, std::size_t column, std::size_t row);

// Relief of kMarkTiles tiles of marks, without load: in true proportions, each vertex the mean of 2 x 2 squares.
HeightRelief marks_relief(std::span<const scene::MarkTile> tiles, const MarksScale& scale);

}  // namespace afm::exhibit
