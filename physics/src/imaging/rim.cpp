// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/rim.h"

#include <utility>
#include <vector>

namespace afm::physics {

Rim::Rim(std::span<const double> edge_m, double half_x_m, double half_y_m, double slope, double narrowest_m)
    : half_x_m_(half_x_m), half_y_m_(half_y_m) {
  for (const double height_m : edge_m) level_m_ += height_m / static_cast<double>(edge_m.size());
  for (const double height_m : edge_m) highest_m_ = std::max(highest_m_, std::abs(height_m - level_m_));
  width_m_ = std::max(narrowest_m, highest_m_ > 0.0 ? highest_m_ / (kSlopeShare * slope) : 0.0);
}

std::vector<double> edge_of(std::span<const double> values, std::size_t columns, std::size_t rows) {
  std::vector<double> edge;
  for (std::size_t row = 0; row < rows; ++row) {
    const std::span<const double> line = values.subspan(row * columns, columns);
    if (row == 0 || row == rows - 1) {
      edge.insert(edge.end(), line.begin(), line.end());
    } else {
      edge.push_back(line.front());
      if (columns > 1) edge.push_back(line.back());
    }
  }
  return edge;
}

std::function<double(double x_m, double y_m)> level_beyond_rim(std::shared_ptr<const HeightGrid> grid) {
  constexpr double kSlope = 0.45;  // steepest slope that is felt (haptics::SampleSurface)
  const double column_m = std::abs(grid->column_step_m), row_m = std::abs(grid->row_step_m);
  const Rim rim(edge_of(grid->height_m, grid->columns, grid->rows),
                0.5 * static_cast<double>(grid->columns - 1) * column_m,
                0.5 * static_cast<double>(grid->rows - 1) * row_m, kSlope, std::max(column_m, row_m));
  return [grid = std::move(grid), rim](double x_m, double y_m) {
    const double share = rim.share_at(x_m, y_m).value, height_m = grid->height_at_m(x_m, y_m);
    return share == 1.0 ? height_m : rim.level_m() + share * (height_m - rim.level_m());
  };
}

}  // namespace afm::physics
