// SPDX-License-Identifier: Apache-2.0
#include "physics/morphology.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace afm::physics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Part of one line of a grid: [first, last) of those pixels whose partner `shift` away exists.
struct Overlap {
  std::size_t first, last;

  Overlap(std::size_t count, std::ptrdiff_t shift)
      : first(shift < 0 ? static_cast<std::size_t>(-shift) : 0),
        last(shift > 0 ? count - std::min(count, static_cast<std::size_t>(shift)) : count) {}
};

std::size_t moved(std::size_t index, std::ptrdiff_t shift) {
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(index) + shift);
}

// Calls change(pixel, partner, T) for every pixel and every one of the tip's that has a partner in the grid, `sign`
// times its offset away, and can matter: what stands higher above the apex than the whole relief never touches.
template <class Change>
void for_each_pair(const HeightGrid& grid, const TipGrid& tip, int sign, const Change& change) {
  const double relief_m = grid.range_m();
  const auto reach_columns = static_cast<std::ptrdiff_t>(tip.reach_columns);
  const auto reach_rows = static_cast<std::ptrdiff_t>(tip.reach_rows);
  const double* above = tip.above_apex_m.data();
  for (std::ptrdiff_t v = -reach_rows; v <= reach_rows; ++v) {
    for (std::ptrdiff_t u = -reach_columns; u <= reach_columns; ++u) {
      const double above_m = *above++;
      if (!(above_m <= relief_m)) continue;
      const Overlap rows(grid.rows, sign * v), columns(grid.columns, sign * u);
      for (std::size_t row = rows.first; row < rows.last; ++row) {
        const std::size_t start = row * grid.columns, partner = moved(row, sign * v) * grid.columns;
        change(start, moved(partner, sign * u), columns, above_m);
      }
    }
  }
}

}  // namespace

HeightGrid dilate(const HeightGrid& surface, const TipGrid& tip) {
  HeightGrid image = surface;
  for_each_pair(surface, tip, 1, [&](std::size_t to, std::size_t from, const Overlap& columns, double above_m) {
    for (std::size_t i = columns.first; i < columns.last; ++i) {
      image.height_m[to + i] = std::max(image.height_m[to + i], surface.height_m[from + i] - above_m);
    }
  });
  return image;
}

HeightGrid erode(const HeightGrid& image, const TipGrid& tip) {
  HeightGrid surface = image;
  for_each_pair(image, tip, -1, [&](std::size_t to, std::size_t from, const Overlap& columns, double above_m) {
    for (std::size_t i = columns.first; i < columns.last; ++i) {
      surface.height_m[to + i] = std::min(surface.height_m[to + i], image.height_m[from + i] + above_m);
    }
  });
  return surface;
}

HeightGrid image_of(const HeightGrid& surface, const TipShape& tip) {
  if (tip.kind != TipKind::Paraboloid || tip.second_apex_distance.si > 0.0) {
    return dilate(surface, sample_tip(tip, surface, surface.range_m()));
  }
  HeightGrid image = surface;
  dilate_by_paraboloid(image, tip.radius);
  return image;
}

HeightGrid reconstruction_of(const HeightGrid& image, const TipShape& tip) {
  if (tip.kind != TipKind::Paraboloid || tip.second_apex_distance.si > 0.0) {
    return erode(image, sample_tip(tip, image, image.range_m()));
  }
  HeightGrid surface = image;
  erode_by_paraboloid(surface, tip.radius);
  return surface;
}

std::vector<std::uint8_t> certainty_map(const HeightGrid& image, const HeightGrid& reconstruction, const TipGrid& tip,
                                        double tolerance_m) {
  std::vector<std::uint8_t> certain(image.height_m.size(), 0);
  const std::size_t margin_x = tip.reach_columns, margin_y = tip.reach_rows;
  if (image.columns <= 2 * margin_x || image.rows <= 2 * margin_y) return certain;
  for (std::size_t row = margin_y; row + margin_y < image.rows; ++row) {
    for (std::size_t column = margin_x; column + margin_x < image.columns; ++column) {
      const double apex_m = image.at(column, row);
      std::size_t touches = 0, touched = 0;
      const double* above = tip.above_apex_m.data();
      for (std::size_t r = row - margin_y; r <= row + margin_y && touches < 2; ++r) {
        for (std::size_t c = column - margin_x; c <= column + margin_x && touches < 2; ++c) {
          if (reconstruction.at(c, r) - *above++ < apex_m - tolerance_m) continue;
          ++touches;
          touched = r * image.columns + c;
        }
      }
      if (touches == 1) certain[touched] = 1;
    }
  }
  return certain;
}

}  // namespace afm::physics
