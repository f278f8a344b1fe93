// SPDX-License-Identifier: Apache-2.0
#include "exhibit/scan/served_image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "support/phrases.h"

namespace afm::exhibit {
namespace served_image_test {

physics::ScanLine line_of(std::size_t row, std::size_t columns) {
  physics::ScanLine line;
  line.row = row;
  for (physics::ScanTrack* track : {&line.trace, &line.retrace}) {
    for (auto* values : {&track->height_m, &track->error_n, &track->lateral_n}) {
      for (std::size_t i = 0; i < columns; ++i) values->push_back(1e-9 * static_cast<double>(row + i));
    }
  }
  return line;
}

std::size_t known(const render::ColorGrid& grid) {
  return static_cast<std::size_t>(
      std::count_if(grid.colors.begin(), grid.colors.end(), [](const auto& color) { return color[3] != 0; }));
}

TEST(ServedImage, HasColoursWhereItWasScanned) {
  ServedImage image({.columns = 16, .rows = 16, .width_m = 1e-7, .height_m = 1e-7, .line_rate_hz = 2.0});
  EXPECT_EQ(known(image.panel("Mica", test::english()).heights[0].grid), 0U);
  for (std::size_t row = 0; row < 4; ++row) image.add(line_of(row, 16));
  image.add(line_of(4, 15));
  image.add(line_of(16, 16));
  const render::ImagePanel panel = image.panel("Mica", test::english());
  EXPECT_EQ(known(panel.heights[0].grid), 64U);
  EXPECT_EQ(panel.profile.lines.front().points.size(), 16U);
  EXPECT_NEAR(panel.line.value(), 3.5 / 16, 1e-12);
  EXPECT_EQ(panel.side_unit, "nm");
}

TEST(ServedImage, LiesInTheMiddleOfItsSquare) {
  ServedImage image({.columns = 32, .rows = 8, .width_m = 4e-8, .height_m = 1e-8, .line_rate_hz = 2.0});
  for (std::size_t row = 0; row < 8; ++row) image.add(line_of(row, 32));
  const render::ColorGrid grid = image.panel("Mica", test::english()).heights[0].grid;
  ASSERT_EQ(grid.columns, 32U);
  EXPECT_EQ(known(grid), 32U * 8U);
  EXPECT_EQ(grid.colors[11 * 32][3], 0);
  EXPECT_EQ(grid.colors[12 * 32][3], 255);
  EXPECT_EQ(grid.colors[20 * 32][3], 0);
}

TEST(ServedImage, IsDrawnWithFewerCellsThanALargeOneHasPixels) {
  ServedImage image({.columns = 1024, .rows = 1024, .width_m = 1e-6, .height_m = 1e-6, .line_rate_hz = 2.0});
  image.add(line_of(512, 1024));
  EXPECT_EQ(image.panel("Mica", test::english()).heights[0].grid.colors.size(), 256U * 256U);
}

}  // namespace served_image_test
}  // namespace afm::exhibit
