// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace afm::generate {

// A rounded grain in each cell of a jittered grid. The eighth-power mean joins them without a kink and in any order.
struct Grains {
  double cell = 0;          // width of a cell
  double smallest = 0;      // height of the smallest grain relative to the largest
  double radius_low = 0.7;  // smallest radius, relative to the cell
  double radius_high = 1.0;
  std::uint32_t seed = 0;

  double height(double x, double y) const;

 private:
  // fourth power of one grain's height at a place in cells; its highest point is at most 1
  double grain(std::int64_t column, std::int64_t row, double x, double y) const;
};

}  // namespace afm::generate
