// SPDX-License-Identifier: Apache-2.0
#include "panels/plot_scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace afm::render {

double tick_step(double range, int most) {
  const double rough = range / most;
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * decade >= rough * (1.0 - 1e-9)) {
      return factor * decade;
    }
  }
  return 10.0 * decade;
}

std::string tick_text(double value, double step, char decimal_mark) {
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  const double rounded = std::abs(value) < 0.5 * std::pow(10.0, -decimals) ? 0.0 : value;
  std::string digits = fmt::format("{:.{}f}", std::abs(rounded), decimals);
  std::replace(digits.begin(), digits.end(), '.', decimal_mark);
  return rounded < 0.0 ? "\u2212" + digits : digits;
}

void thin_out(std::vector<glm::vec2>& points, float column_mm) {
  std::size_t written = 0;  // index that is never ahead of the reading position
  std::size_t begin = 0;
  while (begin < points.size()) {
    const float column = std::floor(points[begin].x / column_mm);
    std::size_t end = begin + 1;
    std::size_t lowest = begin;
    std::size_t highest = begin;
    for (; end < points.size() && std::floor(points[end].x / column_mm) == column; ++end) {
      lowest = points[end].y < points[lowest].y ? end : lowest;
      highest = points[end].y > points[highest].y ? end : highest;
    }
    const std::array<std::size_t, 4> kept{begin, std::min(lowest, highest), std::max(lowest, highest), end - 1};
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (i == 0 || kept[i] != kept[i - 1]) points[written++] = points[kept[i]];
    }
    begin = end;
  }
  points.resize(written);
}

}  // namespace afm::render
