// SPDX-License-Identifier: Apache-2.0
#include "beam.h"

namespace afm::generate {

Surface unit_beam() {
  // twelve directions 30 degrees apart, whose cosines are 0, 1/2, sqrt(3)/2 and 1
  const double c = std::sqrt(0.75);
  const std::vector<V2> directions{{1, 0},  {c, 0.5},   {0.5, c},   {0, 1},  {-0.5, c}, {-c, 0.5},
                                   {-1, 0}, {-c, -0.5}, {-0.5, -c}, {0, -1}, {0.5, -c}, {c, -0.5}};
  Surface surface;
  surface.add_grid(2, directions.size() + 1, [&](std::size_t row, std::size_t column) {
    const V2 d = directions[column % directions.size()];
    return SurfaceVertex{{d.x, d.y, static_cast<double>(row)}, {d.x, d.y, 0}};
  });
  return surface;
}

}  // namespace afm::generate
