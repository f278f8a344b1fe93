// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace afm::physics {

// Heights on a regular grid, row by row. Finite; at least one.
struct HeightGrid {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double x_first_m = 0;  // position of column 0
  double y_first_m = 0;  // position of row 0
  double column_step_m = 1;
  double row_step_m = 1;  // distance of the rows; negative if row 0 is the top one, as in an image
  std::vector<double> height_m;

  double& at(std::size_t column, std::size_t row) { return height_m[row * columns + column]; }
  double at(std::size_t column, std::size_t row) const { return height_m[row * columns + column]; }

  // Bilinear between the points; outside, the height of the nearest point. NaN: the first point's height.
  double height_at_m(double x_m, double y_m) const noexcept;

  // Difference of the highest and the lowest point.
  double range_m() const noexcept;
};

}  // namespace afm::physics
