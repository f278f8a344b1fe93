// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "physics/friction/sideways.h"
#include "physics/manipulation/marking.h"
#include "physics/manipulation/tip_contact.h"
#include "physics/units.h"

// A soft surface as a grid of heights that a tip cuts (docs/manipulation.md, "Scratches").
namespace afm::physics {

// Volumes of all marks. Pressed material springs back, forms ridges, waits below the tip, or is densified:
// pressed = sprung_back + ridges + under_way + densified.
struct MarkVolumes {
  Volume pressed;      // volume displaced by the tip under load
  Volume sprung_back;  // volume that rose again after the tip left
  Volume ridges;
  Volume under_way;  // volume without room beside the tip until it moves on
  Volume densified;
};

// Mean cross-section of a straight groove, without load.
struct GrooveSection {
  Length depth;  // deepest place of the groove; 0: there is no groove
  Length width;  // width of the groove at the height of the surface before the first mark
  Length ridge;  // highest place of the ridges beside the groove
};

// Position of a tip pressed by a lever, and the work that it takes.
struct Sunk {
  Length apex;         // height of the apex
  Volume displaced;    // volume of the material displaced at this place
  Force resistance;    // resistance of the material against motion along the given way
  bool stops = false;  // true: the tip is at its lowest height, and the load exceeds the model of the surface
};

// Heights of a flat surface at z = 0, on squares of R_t/8. Each square under the tip bears the hardness, or lies lower
// than the tip and bears nothing. The tip is within kReach squares of its axis, all of which a call looks at, so
// grooves are at most as wide as 2 R_t before they are deepened (deepest()).
//
// The constructor allocates; nothing else does, nor locks, throws or waits. One thread.
class MarkedSurface {
 public:
  static constexpr int kMostSide = 512;  // largest number of squares along x and along y
  static constexpr int kReach = 16;      // largest distance of a square below the tip from its axis, in squares
  static constexpr double kSquaresPerRadius = 8.0;
  static constexpr std::size_t kTileSide = 16;  // squares along a side of a tile, the unit of copying
  static constexpr std::size_t kTileSquares = kTileSide * kTileSide;

  // Surface for a tip over the rectangle from `least` to `most`. Throws std::invalid_argument if that needs more than
  // kMostSide squares, and as validate() and validate_marking_tip() do.
  MarkedSurface(const SphereCone& tip, const SoftSurface& surface, const Sideways<Length>& least,
                const Sideways<Length>& most);

  // The longest side of a rectangle for a tip.
  static Length longest_side(const SphereCone& tip) noexcept;

  // Returns whether a tip may be there.
  bool holds(const Sideways<Length>& place) const noexcept;

  // The lowest possible height of an apex.
  Length deepest() const noexcept { return Length(deepest_m_); }

  // Upper bound of the surface's height.
  Length highest() const noexcept { return Length(highest_m_); }

  // Lowers that bound to a height above which no point lies, at least to 0.
  void lower_highest(Length height) noexcept;

  Length spacing() const noexcept { return Length(spacing_m_); }

  // The height at which a lever of this spring, whose unbent apex would be at `base`, presses the tip at a place: the
  // least of energy of the lever and hardness times displaced volume. `place` is one that it holds, `along` the way on
  // which the tip comes. An apex near `about` is found sooner, with the same bits.
  Sunk sink(const Sideways<Length>& place, const Sideways<double>& along, Length base, Stiffness spring,
            Length about) const noexcept;

  // Presses the tip in, with a contact of that radius that rises by `back` in its middle when the tip has left. The
  // volume pressed down.
  Volume press(const Sideways<Length>& place, Length apex, Length contact_radius, Length back) noexcept;

  // Piles up the share of what has been pressed down for good since the last call: on both sides of the last motion
  // and behind it, or around a tip that has not moved sideways, `along` of zero length. Only where the tip leaves room.
  void pile_up(const Sideways<Length>& place, Length apex, Length contact_radius,
               const Sideways<double>& along) noexcept;

  // Densifies the material without room beside a tip that leaves.
  void densify_what_waits() noexcept { under_way_m3_ = 0.0; }

  // Height at a place when no tip is there, between the middles of the squares by their distances; 0 beyond them.
  Length height(const Sideways<Length>& place) const noexcept;

  MarkVolumes volumes() const noexcept;

  // Mean section across the middle half of a way.
  GrooveSection section(const Sideways<Length>& from, const Sideways<Length>& to) const noexcept;

  // Volumes by the heights of the grid, without load: below z = 0 and above it.
  Volume below() const noexcept;
  Volume above() const noexcept;

  // The squares; the first one is that with the least x and y. Height when no tip is there.
  std::size_t columns() const noexcept { return columns_; }
  std::size_t rows() const noexcept { return rows_; }
  Length square(std::size_t column, std::size_t row) const noexcept { return Length(square_m(column, row)); }
  Sideways<Length> middle_of_first() const noexcept { return {Length(left_m_), Length(bottom_m_)}; }

  // The surface in tiles, row by row from the least x and y: for each square its height under load, and what it rises
  // by without. Squares beyond the surface are 0, and ignored. put() forgets no volume: those of a surface that was put
  // together from tiles count from then on.
  std::size_t tiles_across() const noexcept { return (columns_ + kTileSide - 1) / kTileSide; }
  std::size_t tiles() const noexcept { return tiles_across() * ((rows_ + kTileSide - 1) / kTileSide); }
  void copy_tile(std::size_t tile, std::span<double, kTileSquares> pressed_m,
                 std::span<double, kTileSquares> back_m) const noexcept;
  void put_tile(std::size_t tile, std::span<const double, kTileSquares> pressed_m,
                std::span<const double, kTileSquares> back_m) noexcept;

  // True for a tile in which a square may have changed since it was kept() last.
  bool changed(std::size_t tile) const noexcept { return changed_[tile] != 0; }
  void kept(std::size_t tile) noexcept { changed_[tile] = 0; }

  // Calls visit(tile) for each tile that a tip at this place can change.
  template <class Visit>
  void tiles_below(const Sideways<Length>& place, const Visit& visit) const noexcept;

 private:
  static constexpr int kSide = 2 * kReach + 1;

  struct Columns {
    std::size_t first, end;
  };

  // The squares within reach of a place: distances of their middles from it along x and y, and the index of the first.
  struct Window {
    std::array<double, kSide> x_m, y_m;
    double squares_per_m;
    std::size_t first;

    // The columns whose middles lie between two distances, and perhaps one more at each end.
    Columns columns_between(double least_m, double most_m) const noexcept {
      const auto column = [&](double from_m) {
        return static_cast<int>(std::clamp((from_m - x_m[0]) * squares_per_m, -1.0, 1.0 * kSide));
      };
      return {static_cast<std::size_t>(std::max(0, column(least_m))),
              static_cast<std::size_t>(std::min(kSide, column(most_m) + 2))};
    }
  };
  Window window(const Sideways<Length>& place) const noexcept;

  // Height of the tip above its apex, and what it rises by with r^2.
  struct Rise {
    double height_m, per_m2_m;
  };
  Rise rise_at(double distance_m2) const noexcept;

  // A square: its index, distances of its middle from the tip's axis, and the tip there.
  struct Above {
    std::size_t index;
    double x_m, y_m, distance_m2;
    Rise tip;
  };
  // Visits each square that is higher than the tip, and few others.
  template <class Visit>
  void above_tip(const Window& window, double apex_m, const Visit& visit) const noexcept;

  // Calls visit(index, weight, squared distance from the axis) for each square on which a ridge grows.
  template <class Visit>
  void beside(const Window& window, double radius_m, const Sideways<double>& along, const Visit& visit) const noexcept;
  double square_m(std::size_t column, std::size_t row) const noexcept;
  void note_change(const Sideways<Length>& place) noexcept;

  double hardness_pa_, pile_up_share_;
  double spacing_m_, deepest_m_, highest_m_ = 0.0;
  std::vector<double> profile_m_;         // heights of the tip above its apex, evenly spaced in r^2, beyond kReach
  double places_per_m2_ = 0.0;            // density of the profile
  double least_rise_per_m_ = 0.0;         // lower bound of the tip's height above its apex divided by r^2, within reach
  double left_m_ = 0.0, bottom_m_ = 0.0;  // position of the middle of the first square
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<double> pressed_m_;      // height of each square under the tip that pressed it last
  std::vector<double> back_m_;         // rise of the surface when the tip has left
  std::vector<std::uint8_t> changed_;  // flag of each tile, 1: changed
  double pressed_m3_ = 0.0, for_good_m3_ = 0.0, ridges_m3_ = 0.0, under_way_m3_ = 0.0;
};

template <class Visit>
void MarkedSurface::tiles_below(const Sideways<Length>& place, const Visit& visit) const noexcept {
  const auto tiles_along = [this](double at_m, double first_m, std::size_t count) {
    const double middle = (at_m - first_m) / spacing_m_, reach = kReach + 0.5, most = static_cast<double>(count - 1);
    return Columns{static_cast<std::size_t>(std::clamp(middle - reach, 0.0, most)) / kTileSide,
                   static_cast<std::size_t>(std::clamp(middle + reach, 0.0, most)) / kTileSide + 1};
  };
  const Columns along_x = tiles_along(place.x.si, left_m_, columns_),
                along_y = tiles_along(place.y.si, bottom_m_, rows_);
  for (std::size_t row = along_y.first; row < along_y.end; ++row) {
    for (std::size_t column = along_x.first; column < along_x.end; ++column) visit(row * tiles_across() + column);
  }
}

}  // namespace afm::physics
