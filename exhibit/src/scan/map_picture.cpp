// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/map_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "curves/live_parameters.h"
#include "exhibit/models/height_colours.h"
#include "physics/quantity_text.h"
#include "scan/image_maps.h"

namespace afm::exhibit {

namespace {

constexpr std::size_t kMostCells = 128;  // largest side of the grid; a pixel of a small map has several

// Number of cells for so many pixels: whole multiples, or as many as are drawn.
std::size_t cells_of(std::size_t pixels) { return pixels >= kMostCells ? kMostCells : pixels * (kMostCells / pixels); }

// The range of the heights but the outermost percent at each end.
Range inner_range(std::vector<double> heights_m) {
  constexpr double kCutShare = 0.01;
  std::erase_if(heights_m, [](double height_m) { return !std::isfinite(height_m); });
  if (heights_m.empty()) return {};
  std::sort(heights_m.begin(), heights_m.end());
  const auto cut = static_cast<std::size_t>(kCutShare * static_cast<double>(heights_m.size()));
  return {heights_m[cut], heights_m[heights_m.size() - 1 - cut], false};
}

// Pixels that one cell covers along a side.
struct Covered {
  std::size_t first = 0, end = 0;
};
Covered covered_by(std::size_t cell, std::size_t cells, std::size_t pixels) {
  const std::size_t first = cell * pixels / cells;
  return {first, std::max(first + 1, (cell + 1) * pixels / cells)};
}

// The first measured height of a cell: a single curve among many pixels without one must be seen. NaN: none.
double height_in(const curves::CurveMap& map, const Covered& rows, const Covered& columns) {
  for (std::size_t row = rows.first; row < rows.end; ++row) {
    for (std::size_t column = columns.first; column < columns.end; ++column) {
      const double height_m = map.heights_m()[row * map.grid().columns + column];
      if (std::isfinite(height_m)) return height_m;
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string height_text(double height_m, const Phrases& phrases) {
  constexpr int kDigits = 3;
  return phrases.number(
      curves::typographic(physics::format_quantity(physics::Length(height_m), physics::kLengthUnits, kDigits)));
}

}  // namespace

render::MapPicture map_picture(const curves::CurveMap& map, const curves::MapPlace& felt, const Phrases& phrases) {
  const curves::MapGrid& pixels = map.grid();
  const Range inner = inner_range(map.heights_m());
  const Range range = at_least(inner, kLeastRangeM);
  render::MapPicture picture{.title = phrases[Phrase::MapHeights],
                             .columns = static_cast<std::uint32_t>(pixels.columns),
                             .rows = static_cast<std::uint32_t>(pixels.rows),
                             .aspect = pixels.width_m / pixels.height_m,
                             .grid = {.columns = static_cast<std::uint32_t>(cells_of(pixels.columns)),
                                      .rows = static_cast<std::uint32_t>(cells_of(pixels.rows)),
                                      .colors = {}},
                             .marked = target_index(felt, map),
                             .bar = {},
                             .lowest = "0",
                             .highest = height_text(range.high - range.low, phrases)};
  for (std::size_t y = 0; y < picture.grid.rows; ++y) {
    const Covered rows = covered_by(y, picture.grid.rows, pixels.rows);
    for (std::size_t x = 0; x < picture.grid.columns; ++x) {
      const double height_m = height_in(map, rows, covered_by(x, picture.grid.columns, pixels.columns));
      const auto [r, g, b] = height_colour((height_m - range.low) / (range.high - range.low));
      picture.grid.colors.push_back({r, g, b, 255});
    }
  }
  for (const Srgb& c : kHeightColours) picture.bar.push_back(glm::vec3(c[0], c[1], c[2]) / 255.0F);
  return picture;
}

std::size_t target_index(const curves::MapPlace& place, const curves::CurveMap& map) {
  return (map.grid().rows - 1 - place.row) * map.grid().columns + place.column;
}

curves::MapPlace place_of(const render::ControlTarget& target, const curves::CurveMap& map) {
  const std::size_t columns = map.grid().columns, rows = map.grid().rows;
  const std::size_t from_top = target.index / columns;
  return {target.index % columns, from_top < rows ? rows - 1 - from_top : rows};
}

}  // namespace afm::exhibit
