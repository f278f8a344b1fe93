// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "physics/imaging/height_grid.h"
#include "physics/rows_of_enum.h"
#include "physics/units.h"

namespace afm::physics {

enum class TipKind { Paraboloid, Sphere, Cone, ThreeSidedPyramid, FourSidedPyramid };

struct TipKindName {
  TipKind kind;
  std::string_view name;  // spelling in options
};

inline constexpr std::array kTipKinds{
    TipKindName{TipKind::Paraboloid, "paraboloid"},
    TipKindName{TipKind::Sphere, "sphere"},
    TipKindName{TipKind::Cone, "cone"},
    TipKindName{TipKind::ThreeSidedPyramid, "pyramid-3"},
    TipKindName{TipKind::FourSidedPyramid, "pyramid-4"},
};
static_assert(has_row_for_each(kTipKinds, &TipKindName::kind));

std::string_view name_of(TipKind kind);

// The end of a tip. A cone and a pyramid end in a ball of the radius, tangent to their faces; a sphere's shaft is as
// wide as the ball. One edge of the three-sided pyramid points along +x, the faces of the four-sided one along x and y.
struct TipShape {
  TipKind kind = TipKind::Paraboloid;
  Length radius{20e-9};           // radius of the end, positive
  double half_angle_rad = 0.3;    // cone and pyramid: angle between axis and face, in (0, pi/2)
  Length second_apex_distance{};  // distance along +x from the first apex; zero: no second apex
  Length second_apex_height{};    // height of the second apex's end above the first apex

  // Height of the tip's surface above the apex, at a lateral position; infinite beyond a sphere's equator.
  double height_above_apex_m(double x_m, double y_m) const noexcept;
};

// A tip on a grid: heights above its apex, `reach` pixels to each side. At least 1 x 1.
struct TipGrid {
  std::size_t reach_columns = 0;
  std::size_t reach_rows = 0;
  std::vector<double> above_apex_m;  // heights row by row; 0 at the apex, in the middle; infinite: no material

  std::size_t columns() const { return 2 * reach_columns + 1; }
  std::size_t rows() const { return 2 * reach_rows + 1; }
};

// The tip up to the height `depth_m`, at the steps of `grid`, but never wider than it.
TipGrid sample_tip(const TipShape& tip, const HeightGrid& grid, double depth_m);

}  // namespace afm::physics
