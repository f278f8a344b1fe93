// SPDX-License-Identifier: Apache-2.0
#include "panels/grid_sheet.h"

#include <algorithm>

#include "core/check.h"

namespace afm::render {
namespace {

// 32-bit FNV-1a (Fowler, Noll, Vo).
std::uint32_t digest_of(const ColorGrid& grid) {
  std::uint32_t digest = 2166136261U;
  for (const auto& color : grid.colors) {
    for (const std::uint8_t byte : color) digest = (digest ^ byte) * 16777619U;
  }
  return digest;
}

}  // namespace

void GridSheet::clear() {
  next_ = {0, 0};
  row_bottom_ = 0;
  texels_.clear();
}

GridSheet::Place GridSheet::add(const ColorGrid& grid) {
  AFM_CHECK(grid.columns > 0 && grid.rows > 0 && grid.columns <= kMostGridCells && grid.rows <= kMostGridCells);
  AFM_CHECK(grid.colors.size() == std::size_t{grid.columns} * grid.rows);
  const glm::uvec2 cells(grid.columns, grid.rows), size = cells + 2U;
  if (next_.x + size.x > kWidth) next_ = {0, row_bottom_};
  row_bottom_ = std::max(row_bottom_, next_.y + size.y);
  texels_.resize(std::size_t{kWidth} * row_bottom_);
  for (std::uint32_t y = 0; y < size.y; ++y) {
    const std::uint32_t row = std::clamp(y, 1U, cells.y) - 1;
    const std::size_t first = std::size_t{row} * cells.x, place = std::size_t{kWidth} * (next_.y + y) + next_.x;
    const auto from = grid.colors.begin() + static_cast<std::ptrdiff_t>(first);
    const auto to = texels_.begin() + static_cast<std::ptrdiff_t>(place);
    *to = *from;
    std::copy_n(from, cells.x, to + 1);
    *(to + 1 + cells.x) = *(from + cells.x - 1);
  }
  const glm::vec2 corner(next_ + 1U);
  next_.x += size.x;
  return {.from = corner, .to = corner + glm::vec2(cells), .digest = digest_of(grid)};
}

}  // namespace afm::render
