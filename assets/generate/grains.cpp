// SPDX-License-Identifier: Apache-2.0
#include "grains.h"

#include <algorithm>
#include <cmath>

#include "exact_math.h"

namespace afm::generate {

double Grains::height(double x, double y) const {
  // the middle of a cell is at the origin, with a separate grain
  const double column = std::floor(x / cell + 0.5), row = std::floor(y / cell + 0.5);
  double sum = 0;
  for (int i = -2; i <= 2; ++i) {
    for (int k = -2; k <= 2; ++k) {
      const double power =
          grain(static_cast<std::int64_t>(column) + i, static_cast<std::int64_t>(row) + k, x / cell, y / cell);
      sum += power * power;
    }
  }
  return std::sqrt(std::sqrt(std::sqrt(sum)));
}

double Grains::grain(std::int64_t column, std::int64_t row, double x, double y) const {
  const bool central = column == 0 && row == 0;
  const double jitter = central ? 0 : 0.8;
  const double dx = x - static_cast<double>(column) - jitter * (random_unit(column, row, seed) - 0.5);
  const double dy = y - static_cast<double>(row) - jitter * (random_unit(column, row, seed + 1) - 0.5);
  const double radius = central ? radius_high : mix(radius_low, radius_high, random_unit(column, row, seed + 2));
  const double top = central ? 0.9 : mix(smallest, 1, random_unit(column, row, seed + 3));
  const double q = (dx * dx + dy * dy) / (radius * radius);
  const double cap = top * std::max(0.0, 1 - q * std::sqrt(q));
  return cap * cap * cap * cap;
}

}  // namespace afm::generate
