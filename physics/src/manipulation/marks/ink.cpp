// SPDX-License-Identifier: Apache-2.0
#include "physics/manipulation/ink.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "physics/contact_parameters.h"
#include "physics/quantity_text.h"
#include "tile_squares.h"

namespace afm::physics {
namespace {

constexpr double kMostMoleculesPerS = 1e12;
constexpr double kLeastFootprintM2 = 1e-21, kMostFootprintM2 = 1e-16;
constexpr int kPlacesAlong = 64, kPlacesAcross = 2048;  // number of positions along and across a line for its width
constexpr double kSpareDistance = 1e-6;                 // margin of a distance for rounding, in squares

double distance2(int columns, int rows) { return 1.0 * columns * columns + 1.0 * rows * rows; }

}  // namespace

void validate(const Ink& ink) {
  if (!(ink.molecules_per_s > 0.0 && ink.molecules_per_s <= kMostMoleculesPerS)) {
    throw UnphysicalValue("molecules_per_s", "it must be positive, and at most 1e12");
  }
  if (!(ink.footprint.si >= kLeastFootprintM2 && ink.footprint.si <= kMostFootprintM2)) {
    throw UnphysicalValue("footprint", "it must be within 0.001 and 100 nm2");
  }
}

Area inked_area(const Ink& ink, Time time) noexcept { return ink.molecules_per_s * time.si * ink.footprint; }

Length ink_dot_radius(const Ink& ink, Time time) noexcept {
  return Length(std::sqrt(inked_area(ink, time).si / std::numbers::pi));
}

Length ink_line_width(const Ink& ink, Velocity speed) noexcept {
  return Length(ink.molecules_per_s * ink.footprint.si / speed.si);
}

InkedSurface::InkedSurface(const Ink& ink, const Sideways<Length>& least, const Sideways<Length>& most, Length margin,
                           Length spacing)
    : squares_per_s_(inked_area(ink, Time(1.0)).si / (spacing.si * spacing.si)),
      spacing_m_(spacing.si),
      left_m_((least.x - margin).si),
      bottom_m_((least.y - margin).si),
      columns_(0),
      rows_(0) {
  validate(ink);
  const auto squares = [&](Length from, Length to) {
    const double count = std::ceil((to - from + 2.0 * margin) / spacing) + 1.0;
    if (!(count >= 1.0 && count <= static_cast<double>(kMostSide))) {
      throw std::invalid_argument("the tip writes over " + format_quantity(to - from, kLengthUnits, 3) +
                                  ": squares of " + format_quantity(spacing, kLengthUnits, 3) + " are too small");
    }
    return static_cast<std::size_t>(count);
  };
  columns_ = squares(least.x, most.x);
  rows_ = squares(least.y, most.y);
  covered_.resize(columns_ * rows_);
  changed_.resize(tiles());
  nearest_.reserve(static_cast<std::size_t>(2 * kReach + 1) * (2 * kReach + 1));
  for (int row = -kReach; row <= kReach; ++row) {
    for (int column = -kReach; column <= kReach; ++column) {
      if (column * column + row * row > kReach * kReach) continue;
      nearest_.push_back({static_cast<std::int16_t>(column), static_cast<std::int16_t>(row)});
    }
  }
  std::stable_sort(nearest_.begin(), nearest_.end(), [](const Offset& a, const Offset& b) {
    return distance2(a.column, a.row) < distance2(b.column, b.row);
  });
}

long InkedSurface::column_of(Length x) const noexcept { return std::lround((x.si - left_m_) / spacing_m_); }
long InkedSurface::row_of(Length y) const noexcept { return std::lround((y.si - bottom_m_) / spacing_m_); }

// All places nearer than the next offset are covered, or beyond the surface; after a step, in a smaller circle.
void InkedSurface::move_to(long column, long row) noexcept {
  if (column == column_ && row == row_) return;
  double known = 0.0;
  if (column_ >= 0) {
    const Offset& next = nearest_[std::min(next_, nearest_.size() - 1)];
    known = std::sqrt(distance2(next.column, next.row)) -
            std::hypot(static_cast<double>(column - column_), static_cast<double>(row - row_)) - kSpareDistance;
  }
  next_ = 0;
  if (known > 1.0) {
    const auto first = std::lower_bound(nearest_.begin(), nearest_.end(), known * known,
                                        [](const Offset& at, double d) { return distance2(at.column, at.row) < d; });
    next_ = static_cast<std::size_t>(first - nearest_.begin());
  }
  column_ = column;
  row_ = row;
}

void InkedSurface::touch(const Sideways<Length>& place, Time time, std::size_t most_looks) noexcept {
  if (!(time.si > 0.0) || !std::isfinite(place.x.si) || !std::isfinite(place.y.si)) return;
  const auto wide = static_cast<long>(columns_), high = static_cast<long>(rows_);
  const long column = column_of(place.x), row = row_of(place.y);
  move_to(column, row);
  waiting_ += squares_per_s_ * time.si;
  std::size_t looks = 0;
  for (; waiting_ >= 1.0 && next_ < nearest_.size() && looks < most_looks; ++next_, ++looks) {
    const long at_column = column + nearest_[next_].column, at_row = row + nearest_[next_].row;
    if (at_column < 0 || at_row < 0 || at_column >= wide || at_row >= high) continue;
    std::uint8_t& square = covered_[static_cast<std::size_t>(at_row * wide + at_column)];
    if (square != 0) continue;
    square = 1;
    const auto tile =
        static_cast<std::size_t>(at_row) / kTileSide * tiles_across() + static_cast<std::size_t>(at_column) / kTileSide;
    changed_[tile] = 1;
    waiting_ -= 1.0;
    covered_squares_ += 1.0;
  }
  if (next_ < nearest_.size()) return;
  lost_squares_ += std::floor(waiting_);
  waiting_ -= std::floor(waiting_);
}

void InkedSurface::lift() noexcept {
  column_ = row_ = -1;
  next_ = 0;
  waiting_ = 0.0;
}

void InkedSurface::copy_tile(std::size_t tile, std::span<std::uint8_t, kTileSquares> covered) const noexcept {
  const TileSquares squares = squares_of_tile(tile, *this, kTileSide);
  std::fill(covered.begin(), covered.end(), std::uint8_t{0});
  for (std::size_t r = 0; r < squares.up; ++r) {
    const std::size_t from = (squares.row + r) * columns_ + squares.column;
    std::copy_n(covered_.data() + from, squares.across, covered.data() + r * kTileSide);
  }
}

void InkedSurface::put_tile(std::size_t tile, std::span<const std::uint8_t, kTileSquares> covered) noexcept {
  const TileSquares squares = squares_of_tile(tile, *this, kTileSide);
  for (std::size_t r = 0; r < squares.up; ++r) {
    const std::size_t to = (squares.row + r) * columns_ + squares.column;
    for (std::size_t c = 0; c < squares.across; ++c) {
      const std::uint8_t now = covered[r * kTileSide + c] != 0 ? 1 : 0;
      covered_squares_ += 1.0 * now - 1.0 * covered_[to + c];
      covered_[to + c] = now;
    }
  }
  changed_[tile] = 1;
}

Area InkedSurface::covered() const noexcept { return Area(covered_squares_ * spacing_m_ * spacing_m_); }
Area InkedSurface::lost() const noexcept { return Area(lost_squares_ * spacing_m_ * spacing_m_); }

bool InkedSurface::is_covered_at(const Sideways<Length>& place) const noexcept {
  const long column = column_of(place.x), row = row_of(place.y);
  if (column < 0 || row < 0 || column >= static_cast<long>(columns_) || row >= static_cast<long>(rows_)) return false;
  return is_covered(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
}

Length InkedSurface::width(const Sideways<Length>& from, const Sideways<Length>& to) const noexcept {
  const Sideways<Length> way = to - from;
  const Length length = magnitude(way);
  if (!(length.si > 0.0)) return {};
  const Sideways<double> across{-(way.y / length), way.x / length};
  const Length step(0.25 * spacing_m_);
  double covered = 0.0;
  for (int k = 0; k < kPlacesAlong; ++k) {
    const Sideways<Length> at = from + way * (0.25 + 0.5 * (k + 0.5) / kPlacesAlong);
    // outwards from the line, on both sides, as far as it is covered
    for (const double side : {-1.0, 1.0}) {
      for (int i = 0; i < kPlacesAcross; ++i) {
        const Length aside = side * (i + 0.5) * step;
        if (!is_covered_at({at.x + aside * across.x, at.y + aside * across.y})) break;
        covered += 1.0;
      }
    }
  }
  return step * (covered / kPlacesAlong);
}

}  // namespace afm::physics
