// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/levelling.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "physics/imaging/scan_image.h"

namespace afm::physics {

namespace {

struct LevelGrid {
  std::vector<double>& heights;
  std::size_t columns;
  std::size_t rows;

  double& at(std::size_t column, std::size_t row) const { return heights[row * columns + column]; }
};

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

// Shifts each line until the median of its differences to the line above is zero. A line without a point measured in
// both moves with the one above.
void level_lines(const LevelGrid& grid) {
  std::vector<double> differences;
  double moved = 0;
  std::vector<double> above(grid.heights.begin(), grid.heights.begin() + static_cast<std::ptrdiff_t>(grid.columns));
  for (std::size_t row = 1; row < grid.rows; ++row) {
    differences.clear();
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const double difference = grid.at(column, row) - above[column];
      if (!std::isnan(difference)) differences.push_back(difference);
      above[column] = grid.at(column, row);
    }
    if (!differences.empty()) moved += median_of(differences);
    for (std::size_t column = 0; column < grid.columns; ++column) grid.at(column, row) -= moved;
  }
}

struct LevelPlane {
  double slope_x = 0;
  double slope_y = 0;  // slope per row, downwards
};

// Normal equations about the centre of the measured points.
LevelPlane fitted_plane(const LevelGrid& grid) {
  double count = 0, mean_x = 0, mean_y = 0, mean_z = 0;
  const auto each = [&](const auto& visit) {
    for (std::size_t row = 0; row < grid.rows; ++row) {
      for (std::size_t column = 0; column < grid.columns; ++column) {
        const double z = grid.at(column, row);
        if (!std::isnan(z)) visit(static_cast<double>(column), static_cast<double>(row), z);
      }
    }
  };
  each([&](double x, double y, double z) {
    ++count;
    mean_x += x;
    mean_y += y;
    mean_z += z;
  });
  mean_x /= count;
  mean_y /= count;
  mean_z /= count;
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0;
  each([&](double x, double y, double z) {
    const double dx = x - mean_x, dy = y - mean_y, dz = z - mean_z;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
    xz += dx * dz;
    yz += dy * dz;
  });
  const double determinant = xx * yy - xy * xy;
  // all points are on one line: the plane is undefined
  if (!(determinant > 1e-9 * xx * yy)) return {};
  return {(xz * yy - yz * xy) / determinant, (yz * xx - xz * xy) / determinant};
}

void take_off(const LevelGrid& grid, const LevelPlane& plane) {
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      grid.at(column, row) -= plane.slope_x * static_cast<double>(column) + plane.slope_y * static_cast<double>(row);
    }
  }
}

// The mean of the known neighbours; NaN if there are none.
double mean_around(const LevelGrid& grid, std::size_t index) {
  const std::size_t column = index % grid.columns, row = index / grid.columns;
  double sum = 0, count = 0;
  for (std::size_t r = row > 0 ? row - 1 : 0; r <= std::min(row + 1, grid.rows - 1); ++r) {
    for (std::size_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, grid.columns - 1); ++c) {
      if (std::isnan(grid.at(c, r))) continue;
      sum += grid.at(c, r);
      ++count;
    }
  }
  return sum / count;
}

std::size_t fill_unmeasured(const LevelGrid& grid) {
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < grid.heights.size(); ++i) {
    if (std::isnan(grid.heights[i])) open.push_back(i);
  }
  const std::size_t filled = open.size();
  std::vector<std::size_t> still_open;
  std::vector<std::pair<std::size_t, double>> ring;
  while (!open.empty()) {
    ring.clear();
    still_open.clear();
    for (const std::size_t index : open) {
      const double height = mean_around(grid, index);
      if (std::isnan(height)) {
        still_open.push_back(index);
      } else {
        ring.emplace_back(index, height);
      }
    }
    for (const auto& [index, height] : ring) grid.heights[index] = height;
    open.swap(still_open);
  }
  return filled;
}

}  // namespace

HeightStatistics height_statistics(std::span<const double> heights) {
  HeightStatistics statistics;
  double sum = 0;
  for (const double height : heights) {
    if (std::isnan(height)) continue;
    if (statistics.measured == 0) statistics.lowest = statistics.highest = height;
    ++statistics.measured;
    sum += height;
    statistics.lowest = std::min(statistics.lowest, height);
    statistics.highest = std::max(statistics.highest, height);
  }
  if (statistics.measured == 0) return statistics;
  const auto count = static_cast<double>(statistics.measured);
  statistics.mean = sum / count;
  double squares = 0;
  for (const double height : heights) {
    if (!std::isnan(height)) squares += (height - statistics.mean) * (height - statistics.mean);
  }
  statistics.sq = std::sqrt(squares / count);
  return statistics;
}

LevelledHeights levelled(std::span<const double> heights, std::size_t columns, std::size_t rows, Levelling levelling) {
  if (columns == 0 || rows == 0 || heights.size() / columns != rows || heights.size() % columns != 0) {
    throw std::invalid_argument("the heights do not fill their columns and rows");
  }
  LevelledHeights result;
  result.heights.assign(heights.begin(), heights.end());
  const LevelGrid grid{result.heights, columns, rows};
  const HeightStatistics before = height_statistics(heights);
  if (before.measured == 0) throw std::invalid_argument("no height was measured");
  if (!(before.lowest >= -kMostImageValue && before.highest <= kMostImageValue)) {
    throw std::invalid_argument("a height is beyond what any instrument measures");
  }
  if (levelling == Levelling::Lines) level_lines(grid);
  if (levelling != Levelling::None) {
    const LevelPlane plane = fitted_plane(grid);
    take_off(grid, plane);
    result.slope_x = plane.slope_x;
    result.slope_y = -plane.slope_y;
    const double shift = before.mean - height_statistics(result.heights).mean;
    for (double& height : result.heights) height += shift;
  }
  result.filled = fill_unmeasured(grid);
  return result;
}

}  // namespace afm::physics
