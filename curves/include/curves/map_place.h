// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace afm::curves {

// A pixel of a map (curves/recorded_curve.h) without its grid. Column 0 is at the left, row 0 at the bottom.
struct MapPlace {
  std::size_t column = 0, row = 0;
  bool operator==(const MapPlace&) const = default;
};

}  // namespace afm::curves
