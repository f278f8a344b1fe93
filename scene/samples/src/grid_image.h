// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "core/written_by.h"
#include "physics/imaging/scan_image.h"

namespace afm::scene {

// Heights of a grid of squares as an image, row by row from the largest y; `height_m(column, row)` is that of a square.
template <class Grid, class Height>
physics::ScanImage grid_image(const Grid& grid, const std::string& title, const std::string& sample,
                              const Height& height_m) {
  physics::ScanImage image;
  image.columns = grid.columns();
  image.rows = grid.rows();
  const double spacing_m = grid.spacing().si;
  image.width_m = spacing_m * static_cast<double>(image.columns);
  image.height_m = spacing_m * static_cast<double>(image.rows);
  image.x_offset_m = grid.middle_of_first().x.si - 0.5 * spacing_m;
  image.y_offset_m = grid.middle_of_first().y.si - 0.5 * spacing_m;
  physics::ImageChannel heights{.name = "Height", .unit = "m", .values = {}};
  heights.values.reserve(image.columns * image.rows);
  for (std::size_t row = image.rows; row-- > 0;) {
    for (std::size_t column = 0; column < image.columns; ++column) heights.values.push_back(height_m(column, row));
  }
  image.channels.push_back(std::move(heights));
  image.metadata = {{"Title", title},
                    {"Sample", sample},
                    {"Source", "calculated by touchafm particles"},
                    {"Software", core::written_by()}};
  return image;
}

}  // namespace afm::scene
