// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/marks_relief.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/check.h"
#include "physics/manipulation/marked_surface.h"
#include "scene/samples/ink_run.h"
#include "scene/samples/particle_set.h"
#include "scene/shared/soft_blocks.h"

namespace afm::exhibit {

namespace {

constexpr double kColoursOfRadius = 0.125;
constexpr std::size_t kSquaresOfVertex = scene::kSoftSide / kReliefSide;
static_assert(kSquaresOfVertex * kReliefSide == scene::kSoftSide);

}  // namespace

double mark_height_m(std::span<const scene::MarkTile> tiles, std::size_t column, std::size_t row) {
  constexpr std::size_t kSide = scene::kTileSide, kAcross = scene::kSoftSide / kSide;
  const scene::MarkTile& tile = tiles[row / kSide * kAcross + column / kSide];
  const std::size_t square = row % kSide * kSide + column % kSide;
  return tile.pressed_m[square] + tile.back_m[square];
}

MarksScale marks_scale(const scene::ParticleSet& set) {
  AFM_CHECK(set.soft || set.ink);
  if (set.ink) {
    return {.side_m = scene::ink_side_m(set.ink->ink), .colours_m = set.ink->thickness.si, .only_up = true};
  }
  const double radius_m = set.setup.tip.radius.si;
  return {.side_m = scene::kSoftSide * radius_m / physics::MarkedSurface::kSquaresPerRadius,
          .colours_m = kColoursOfRadius * radius_m};
}

HeightRelief marks_relief(std::span<const scene::MarkTile> tiles, const MarksScale& scale) {
  AFM_CHECK(tiles.size() == scene::kMarkTiles);
  std::vector<double> heights_m;
  heights_m.reserve(kReliefSide * kReliefSide);
  for (std::size_t row = kReliefSide; row-- > 0;) {  // rows from +y
    for (std::size_t column = 0; column < kReliefSide; ++column) {
      double sum_m = 0.0;
      for (std::size_t i = 0; i < kSquaresOfVertex * kSquaresOfVertex; ++i) {
        sum_m += mark_height_m(tiles, column * kSquaresOfVertex + i % kSquaresOfVertex,
                               row * kSquaresOfVertex + i / kSquaresOfVertex);
      }
      heights_m.push_back(sum_m / (kSquaresOfVertex * kSquaresOfVertex));
    }
  }
  const auto [low, high] = std::minmax_element(heights_m.begin(), heights_m.end());
  const double most_m = std::max({scale.colours_m, -*low, *high});
  return relief_of(heights_m, scale.side_m, {.low_m = scale.only_up ? 0.0 : -most_m, .high_m = most_m});
}

}  // namespace afm::exhibit
