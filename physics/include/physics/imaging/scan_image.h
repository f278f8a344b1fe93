// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace afm::physics {

// Limit of a channel's values: far beyond any instrument's, and small enough to keep sums of products of two finite.
inline constexpr double kMostImageValue = 1e100;

// One quantity of a scan, row by row. Row 0 is the top one, with the largest y; columns run along x. NaN: not measured.
struct ImageChannel {
  std::string name;  // channel name as in AFM programs: "Height", "Deflection", "Lateral force (retrace)"
  std::string unit;  // SI unit of the values: "m", "N", "V", ""
  std::vector<double> values;
};

// Content of an AFM's image file, from the virtual microscope or from an instrument.
struct ScanImage {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double width_m = 0;     // width of the scanned area: columns times a pixel's width
  double height_m = 0;    // height of the scanned area: rows times a pixel's height
  double x_offset_m = 0;  // left edge of the area
  double y_offset_m = 0;  // top edge of the area
  std::vector<ImageChannel> channels;
  std::vector<std::pair<std::string, std::string>> metadata;  // key and value as text
};

}  // namespace afm::physics
