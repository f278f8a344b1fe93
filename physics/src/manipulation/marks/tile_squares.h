// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

namespace afm::physics {

// Squares of a tile that lie on a grid: the first one, and how many along x and y.
struct TileSquares {
  std::size_t column, row, across, up;
};

// `side` is that of a tile. Works for every grid with tiles_across(), columns() and rows().
template <class Grid>
TileSquares squares_of_tile(std::size_t tile, const Grid& grid, std::size_t side) noexcept {
  const std::size_t column = tile % grid.tiles_across() * side, row = tile / grid.tiles_across() * side;
  return {column, row, std::min(side, grid.columns() - column), std::min(side, grid.rows() - row)};
}

}  // namespace afm::physics
