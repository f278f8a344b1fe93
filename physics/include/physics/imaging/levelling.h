// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "physics/rows_of_enum.h"

namespace afm::physics {

// Correction of a measured topography before it is shown or felt. Plane: removes the sample's tilt. Lines: also the
// instrument's steps from one line to the next.
enum class Levelling { None, Plane, Lines };

struct LevellingText {
  Levelling levelling;
  std::string_view word;     // value on the command line
  std::string_view meaning;  // description of what it subtracts
};

inline constexpr std::array kLevellings{
    LevellingText{Levelling::None, "none", "nothing"},
    LevellingText{Levelling::Plane, "plane", "the plane of least squares"},
    LevellingText{Levelling::Lines, "lines",
                  "the median of the differences line by line, then the plane of least squares"}};
static_assert(has_row_for_each(kLevellings, &LevellingText::levelling));

constexpr const LevellingText& text_of(Levelling levelling) { return kLevellings[static_cast<std::size_t>(levelling)]; }

// Statistics of the measured points, ignoring NaN. Sq is the root mean square of the distance from the mean (ISO
// 25178-2, 4.2.1).
struct HeightStatistics {
  std::size_t measured = 0;
  double mean = 0;
  double sq = 0;
  double lowest = 0;
  double highest = 0;
};
HeightStatistics height_statistics(std::span<const double> heights);

struct LevelledHeights {
  std::vector<double> heights;  // finite heights; row 0 at the top, as in ScanImage
  double slope_x = 0;           // slope of the subtracted plane along a row: per column, to the right
  double slope_y = 0;           // slope of the subtracted plane across rows: per row, upwards
  std::size_t filled = 0;       // number of points without a measurement
};

// `heights` row by row. Points without a measurement (NaN) do not influence the levelling; then they are filled ring by
// ring, each with the mean of the known ones of its eight neighbours. The mean height does not change. Throws
// std::invalid_argument unless the sizes fit, a point was measured, and none is beyond kMostImageValue (scan_image.h),
// which would overflow the sums.
LevelledHeights levelled(std::span<const double> heights, std::size_t columns, std::size_t rows, Levelling levelling);

}  // namespace afm::physics
