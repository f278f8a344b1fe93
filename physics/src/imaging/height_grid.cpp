// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/height_grid.h"

#include <algorithm>
#include <cmath>

namespace afm::physics {
namespace {

struct BetweenPoints {
  std::size_t first, second;
  double share;  // weight of the second of two neighbours
};

BetweenPoints between_points(double place_m, double first_m, double step_m, std::size_t count) {
  // in this order NaN becomes the first point
  const double last = static_cast<double>(count - 1);
  const double index = std::min(std::max(0.0, (place_m - first_m) / step_m), last);
  const double below = std::floor(index);
  const auto first = static_cast<std::size_t>(below);
  return {first, std::min(first + 1, count - 1), index - below};
}

}  // namespace

double HeightGrid::height_at_m(double x_m, double y_m) const noexcept {
  const BetweenPoints c = between_points(x_m, x_first_m, column_step_m, columns);
  const BetweenPoints r = between_points(y_m, y_first_m, row_step_m, rows);
  const double above = at(c.first, r.first) + c.share * (at(c.second, r.first) - at(c.first, r.first));
  const double below = at(c.first, r.second) + c.share * (at(c.second, r.second) - at(c.first, r.second));
  return above + r.share * (below - above);
}

double HeightGrid::range_m() const noexcept {
  const auto [lowest, highest] = std::minmax_element(height_m.begin(), height_m.end());
  return *highest - *lowest;
}

}  // namespace afm::physics
