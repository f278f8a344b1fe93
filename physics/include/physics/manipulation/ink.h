// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "physics/friction/sideways.h"
#include "physics/units.h"

// A tip that writes with molecules: dip-pen lithography (docs/manipulation.md, "Ink").
namespace afm::physics {

// Molecules that flow from a touching tip at a constant rate and cover the sample in one layer.
struct Ink {
  double molecules_per_s = 0.0;  // J, rate of flow
  Area footprint;                // a, area covered by one molecule
};

// Throws UnphysicalValue with the field molecules_per_s or footprint.
void validate(const Ink& ink);

// Area covered in a time, J a t, and the radius of the dot of a tip at rest (M80).
Area inked_area(const Ink& ink, Time time) noexcept;
Length ink_dot_radius(const Ink& ink, Time time) noexcept;

// Width of the line of a moving tip, J a/v (M81).
Length ink_line_width(const Ink& ink, Velocity speed) noexcept;

// Squares of a flat sample that ink covers. What flows from the tip covers the nearest bare square, so that a dot grows
// at its rim, as by diffusion over the covered part. The area is exact: a fraction of a square waits in the tip.
//
// The constructor allocates; nothing else does, nor locks, throws or waits. One thread. The result depends on places
// and times of the tip, never on a clock.
class InkedSurface {
 public:
  static constexpr std::size_t kMostSide = 1024;  // largest number of squares along x and along y
  static constexpr int kReach = 256;              // largest distance from the tip to a square that it covers
  static constexpr std::size_t kTileSide = 16;    // squares along a side of a tile, the unit of copying
  static constexpr std::size_t kTileSquares = kTileSide * kTileSide;

  // Surface for a tip over the rectangle from `least` to `most`, with a margin around it. Throws std::invalid_argument
  // if that needs more than kMostSide squares, and as validate() does.
  InkedSurface(const Ink& ink, const Sideways<Length>& least, const Sideways<Length>& most, Length margin,
               Length spacing);

  // Lets ink flow while the tip touches this place. Ink beyond the nearest `most_looks` squares waits in the tip.
  void touch(const Sideways<Length>& place, Time time,
             std::size_t most_looks = std::numeric_limits<std::size_t>::max()) noexcept;

  // Takes the tip off: what waits in it is given up, so that what it covers next depends only on the surface.
  void lift() noexcept;

  Area covered() const noexcept;  // area covered since the start
  Area lost() const noexcept;     // area of the ink that flowed out with no bare square within reach

  // Mean width of what is covered across the middle half of a way.
  Length width(const Sideways<Length>& from, const Sideways<Length>& to) const noexcept;

  std::size_t columns() const noexcept { return columns_; }
  std::size_t rows() const noexcept { return rows_; }
  Length spacing() const noexcept { return Length(spacing_m_); }
  bool is_covered(std::size_t column, std::size_t row) const noexcept { return covered_[row * columns_ + column] != 0; }
  Sideways<Length> middle_of_first() const noexcept { return {Length(left_m_), Length(bottom_m_)}; }

  // The surface in tiles, row by row from the least x and y: 1 for each covered square, 0 for a bare one or one beyond
  // the surface, which put_tile() ignores. A tip that touches has to be lifted before a tile is put.
  std::size_t tiles_across() const noexcept { return (columns_ + kTileSide - 1) / kTileSide; }
  std::size_t tiles() const noexcept { return tiles_across() * ((rows_ + kTileSide - 1) / kTileSide); }
  void copy_tile(std::size_t tile, std::span<std::uint8_t, kTileSquares> covered) const noexcept;
  void put_tile(std::size_t tile, std::span<const std::uint8_t, kTileSquares> covered) noexcept;

  // True for a tile in which a square may have changed since it was kept() last.
  bool changed(std::size_t tile) const noexcept { return changed_[tile] != 0; }
  void kept(std::size_t tile) noexcept { changed_[tile] = 0; }

 private:
  struct Offset {
    std::int16_t column, row;
  };

  long column_of(Length x) const noexcept;
  long row_of(Length y) const noexcept;
  bool is_covered_at(const Sideways<Length>& place) const noexcept;
  void move_to(long column, long row) noexcept;

  double squares_per_s_;
  double spacing_m_, left_m_, bottom_m_;
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> covered_;
  std::vector<std::uint8_t> changed_;  // flag of each tile, 1: changed
  std::vector<Offset> nearest_;        // offsets within reach, the nearest first
  std::size_t next_ = 0;               // first offset that may be bare at the place of the last touch
  long column_ = -1, row_ = -1;        // square of the last touch
  double waiting_ = 0.0;               // squares' worth of ink that has flowed out and covers nothing yet
  double covered_squares_ = 0.0, lost_squares_ = 0.0;
};

}  // namespace afm::physics
