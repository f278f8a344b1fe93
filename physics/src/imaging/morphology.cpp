// SPDX-License-Identifier: Apache-2.0
#include "physics/imaging/morphology.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace afm::physics {
namespace {

// Part of one line of a grid: the pixels [first, last) whose partner at the distance `shift` exists.
struct Overlap {
  std::size_t first, last;

  Overlap(std::size_t count, std::ptrdiff_t shift)
      : first(shift < 0 ? static_cast<std::size_t>(-shift) : 0),
        last(shift > 0 ? count - std::min(count, static_cast<std::size_t>(shift)) : count) {}
};

std::size_t moved(std::size_t index, std::ptrdiff_t shift) {
  return static_cast<std::size_t>(static_cast<std::ptrdiff_t>(index) + shift);
}

// Calls change(pixel, partner, T) for every pixel of the grid and every one of the tip that has a partner in the grid,
// `sign` times its offset away. Skips parts of the tip higher above the apex than the whole relief, which never touch.
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

// Number of pixels to each side of the apex at which the tip is not above some height.
class TipReach {
 public:
  explicit TipReach(const TipGrid& tip)
      : lowest_of_column_m_(tip.reach_columns + 1, kNowhere), lowest_of_row_m_(tip.reach_rows + 1, kNowhere) {
    const auto away = [](std::size_t index, std::size_t middle) {
      return index > middle ? index - middle : middle - index;
    };
    for (std::size_t i = 0; i < tip.above_apex_m.size(); ++i) {
      double& column_m = lowest_of_column_m_[away(i % tip.columns(), tip.reach_columns)];
      double& row_m = lowest_of_row_m_[away(i / tip.columns(), tip.reach_rows)];
      column_m = std::min(column_m, tip.above_apex_m[i]);
      row_m = std::min(row_m, tip.above_apex_m[i]);
    }
  }

  std::size_t columns(double above_m) const { return reach(lowest_of_column_m_, above_m); }
  std::size_t rows(double above_m) const { return reach(lowest_of_row_m_, above_m); }

 private:
  static constexpr double kNowhere = std::numeric_limits<double>::infinity();

  static std::size_t reach(const std::vector<double>& lowest_m, double above_m) {
    std::size_t pixels = lowest_m.size() - 1;
    while (pixels > 0 && lowest_m[pixels] > above_m) --pixels;
    return pixels;
  }

  std::vector<double> lowest_of_column_m_;  // lowest point of the tip per column, indexed by pixels from its apex
  std::vector<double> lowest_of_row_m_;
};

bool is_single_paraboloid(const TipShape& tip) {
  return tip.kind == TipKind::Paraboloid && !(tip.second_apex_distance.si > 0.0);
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
  if (!is_single_paraboloid(tip)) {
    return dilate(surface, sample_tip(tip, surface, surface.range_m()));
  }
  HeightGrid image = surface;
  dilate_by_paraboloid(image, tip.radius);
  return image;
}

HeightGrid reconstruction_of(const HeightGrid& image, const TipShape& tip) {
  if (!is_single_paraboloid(tip)) {
    return erode(image, sample_tip(tip, image, image.range_m()));
  }
  HeightGrid surface = image;
  erode_by_paraboloid(surface, tip.radius);
  return surface;
}

std::vector<std::uint8_t> certainty_map(const HeightGrid& image, const HeightGrid& reconstruction, const TipGrid& tip,
                                        double tolerance_m) {
  std::vector<std::uint8_t> certain(image.height_m.size(), 0);
  const double highest_m = *std::max_element(reconstruction.height_m.begin(), reconstruction.height_m.end());
  const TipReach reach(tip);
  for (std::size_t row = 0; row < image.rows; ++row) {
    for (std::size_t column = 0; column < image.columns; ++column) {
      const double apex_m = image.at(column, row);
      const std::size_t x = reach.columns(highest_m - apex_m), y = reach.rows(highest_m - apex_m);
      if (column < x || column + x >= image.columns || row < y || row + y >= image.rows) continue;
      std::size_t touches = 0, touched = 0;
      for (std::size_t r = row - y; r <= row + y && touches < 2; ++r) {
        const double* above = &tip.above_apex_m[(tip.reach_rows + r - row) * tip.columns() + tip.reach_columns - x];
        for (std::size_t c = column - x; c <= column + x && touches < 2; ++c) {
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
