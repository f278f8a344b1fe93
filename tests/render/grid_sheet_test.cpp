// SPDX-License-Identifier: Apache-2.0
#include "panels/grid_sheet.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace afm::render {
namespace grid_sheet_test {

// A grid whose cells all differ.
ColorGrid numbered(std::uint32_t columns, std::uint32_t rows, std::uint8_t mark) {
  ColorGrid grid{.columns = columns, .rows = rows, .colors = {}};
  for (std::uint32_t row = 0; row < rows; ++row) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      grid.colors.push_back({static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row), mark, 255});
    }
  }
  return grid;
}

std::array<std::uint8_t, 4> texel(const GridSheet& sheet, glm::vec2 place) {
  return sheet.texels()[static_cast<std::size_t>(place.y) * GridSheet::kWidth + static_cast<std::size_t>(place.x)];
}

TEST(GridSheet, HoldsEveryCellOfEveryGrid) {
  GridSheet sheet;
  std::vector<ColorGrid> grids;
  std::vector<GridSheet::Place> places;
  for (std::uint8_t i = 0; i < 12; ++i) {
    grids.push_back(numbered(i % 3 == 0 ? kMostGridCells : 90U + i, 2U + 11U * i, i));
    places.push_back(sheet.add(grids.back()));
  }
  for (std::size_t i = 0; i < grids.size(); ++i) {
    for (std::uint32_t row = 0; row < grids[i].rows; ++row) {
      for (std::uint32_t column = 0; column < grids[i].columns; ++column) {
        ASSERT_EQ(texel(sheet, places[i].from + glm::vec2(column, row)),
                  grids[i].colors[row * grids[i].columns + column])
            << "grid " << i << ", column " << column << ", row " << row;
      }
    }
    EXPECT_EQ(places[i].to - places[i].from, glm::vec2(grids[i].columns, grids[i].rows));
  }
}

TEST(GridSheet, RepeatsTheOutermostCellsAroundAGrid) {
  GridSheet sheet;
  sheet.add(numbered(40, 30, 7));
  const GridSheet::Place place = sheet.add(numbered(40, 30, 8));
  const glm::vec2 right(39.0F, 0.0F), down(0.0F, 29.0F);
  EXPECT_EQ(texel(sheet, place.from - glm::vec2(1.0F)), texel(sheet, place.from));
  EXPECT_EQ(texel(sheet, place.from + glm::vec2(17.0F, -1.0F)), texel(sheet, place.from + glm::vec2(17.0F, 0.0F)));
  EXPECT_EQ(texel(sheet, place.to), texel(sheet, place.from + right + down));
  EXPECT_EQ(texel(sheet, place.from + right + glm::vec2(1.0F, 5.0F)),
            texel(sheet, place.from + right + glm::vec2(0.0F, 5.0F)));
}

TEST(GridSheet, ReportsAColourThatHasChanged) {
  GridSheet sheet;
  ColorGrid grid = numbered(40, 30, 7);
  const std::uint32_t before = sheet.add(grid).digest;
  sheet.clear();
  EXPECT_TRUE(sheet.empty());
  EXPECT_EQ(sheet.add(grid).digest, before);
  grid.colors[517][3] = 0;
  EXPECT_NE(sheet.add(grid).digest, before);
}

}  // namespace grid_sheet_test
}  // namespace afm::render
