// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "physics/manipulation/marked_surface.h"
#include "tile_squares.h"

// The tiles of a marked surface.
namespace afm::physics {

void MarkedSurface::copy_tile(std::size_t tile, std::span<double, kTileSquares> pressed_m,
                              std::span<double, kTileSquares> back_m) const noexcept {
  const TileSquares squares = squares_of_tile(tile, *this, kTileSide);
  std::fill(pressed_m.begin(), pressed_m.end(), 0.0);
  std::fill(back_m.begin(), back_m.end(), 0.0);
  for (std::size_t r = 0; r < squares.up; ++r) {
    const std::size_t from = (squares.row + r) * columns_ + squares.column;
    std::copy_n(pressed_m_.data() + from, squares.across, pressed_m.data() + r * kTileSide);
    std::copy_n(back_m_.data() + from, squares.across, back_m.data() + r * kTileSide);
  }
}

void MarkedSurface::put_tile(std::size_t tile, std::span<const double, kTileSquares> pressed_m,
                             std::span<const double, kTileSquares> back_m) noexcept {
  const TileSquares squares = squares_of_tile(tile, *this, kTileSide);
  for (std::size_t r = 0; r < squares.up; ++r) {
    const std::size_t to = (squares.row + r) * columns_ + squares.column;
    std::copy_n(pressed_m.data() + r * kTileSide, squares.across, pressed_m_.data() + to);
    std::copy_n(back_m.data() + r * kTileSide, squares.across, back_m_.data() + to);
    for (std::size_t c = 0; c < squares.across; ++c) {
      highest_m_ = std::max(highest_m_, pressed_m_[to + c] + back_m_[to + c]);
    }
  }
  changed_[tile] = 1;
}

void MarkedSurface::lower_highest(Length height) noexcept { highest_m_ = std::clamp(height.si, 0.0, highest_m_); }

void MarkedSurface::note_change(const Sideways<Length>& place) noexcept {
  tiles_below(place, [this](std::size_t tile) { changed_[tile] = 1; });
}

}  // namespace afm::physics
