// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/marks_relief.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/check.h"
#include "physics/manipulation/marked_surface.h"

namespace afm::exhibit {

namespace {

constexpr double kColoursOfRadius = 0.125;
constexpr std::size_t kSquaresOfVertex = scene::kSoftSide / kReliefSide;
static_assert(kSquaresOfVertex * kReliefSide == scene::kSoftSide);

// Of a square, by its column and row from the least x and y.
double square_height_m(std::span<const scene::MarkTile> tiles, std::size_t column, std::size_t row) {
  constexpr std::size_t kSide = scene::kTileSide, kAcross = scene::kSoftSide / kSide;
  const scene::MarkTile& tile = tiles[row / kSide * kAcross + column / kSide];
  const std::size_t square = row % kSide * kSide + column % kSide;
  return tile.pressed_m[square] + tile.back_m[square];
}

}  // namespace

double marks_side_m(double tip_radius_m) {
  return scene::kSoftSide * tip_radius_m / physics::MarkedSurface::kSquaresPerRadius;
}

HeightRelief marks_relief(std::span<const scene::MarkTile> tiles, double tip_radius_m) {
  AFM_CHECK(tiles.size() == scene::kMarkTiles);
  std::vector<double> heights_m;
  heights_m.reserve(kReliefSide * kReliefSide);
  for (std::size_t row = kReliefSide; row-- > 0;) {  // from +y
    for (std::size_t column = 0; column < kReliefSide; ++column) {
      double sum_m = 0.0;
      for (std::size_t i = 0; i < kSquaresOfVertex * kSquaresOfVertex; ++i) {
        sum_m += square_height_m(tiles, column * kSquaresOfVertex + i % kSquaresOfVertex,
                                 row * kSquaresOfVertex + i / kSquaresOfVertex);
      }
      heights_m.push_back(sum_m / (kSquaresOfVertex * kSquaresOfVertex));
    }
  }
  const auto [low, high] = std::minmax_element(heights_m.begin(), heights_m.end());
  const double most_m = std::max({kColoursOfRadius * tip_radius_m, -*low, *high});
  return relief_of(heights_m, marks_side_m(tip_radius_m), {.low_m = -most_m, .high_m = most_m});
}

}  // namespace afm::exhibit
