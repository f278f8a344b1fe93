// SPDX-License-Identifier: Apache-2.0
#include "images/image_pages.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>

#include "curves/curve_error.h"

namespace afm::curves {

std::size_t image_side(double count) {
  if (!(count >= 2.0 && count <= static_cast<double>(kMostImageSide)) || count != std::floor(count)) {
    const std::string_view advice = count == 1.0             ? ": it is a profile, not an image"
                                    : count > kMostImageSide ? ": save it with fewer points"
                                                             : "";
    throw CurveError(fmt::format("points on a side: {:.12g}; 2 to {} are read{}", count, kMostImageSide, advice));
  }
  return static_cast<std::size_t>(count);
}

double image_length_m(double length, const ScaledUnit& unit) {
  if (!unit.unit.empty() && unit.unit != "m") {
    throw CurveError(fmt::format("its sides are in \"{}\", not in a length", unit.unit.substr(0, 40)));
  }
  const double length_m = std::abs(length * unit.factor);
  if (!(length_m > 0.0 && length_m <= kLongestSideM)) {
    throw CurveError(
        fmt::format("its side of {:g} m is not that of a scan: up to {:g} m is read; set its size in the program "
                    "that wrote it",
                    length * unit.factor, kLongestSideM));
  }
  return length_m;
}

}  // namespace afm::curves
