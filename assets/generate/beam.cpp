// SPDX-License-Identifier: Apache-2.0
#include "beam.h"

namespace afm::generate {

namespace {

// Twelve directions 30 degrees apart, whose cosines are 0, 1/2, sqrt(3)/2 and 1.
std::vector<V2> directions() {
  const double c = std::sqrt(0.75);
  return {{1, 0},  {c, 0.5},   {0.5, c},   {0, 1},  {-0.5, c}, {-c, 0.5},
          {-1, 0}, {-c, -0.5}, {-0.5, -c}, {0, -1}, {0.5, -c}, {c, -0.5}};
}

}  // namespace

Surface unit_beam() {
  const std::vector<V2> around = directions();
  Surface surface;
  surface.add_grid(2, around.size() + 1, [&](std::size_t row, std::size_t column) {
    const V2 d = around[column % around.size()];
    return SurfaceVertex{{d.x, d.y, static_cast<double>(row)}, {d.x, d.y, 0}};
  });
  return surface;
}

Surface beam_outline(double radius) {
  const std::vector<V2> around = directions();
  Surface surface;
  surface.add_grid(2, around.size() + 1, [&](std::size_t row, std::size_t column) {
    const V2 d = around[column % around.size()];
    return SurfaceVertex{{radius * d.x, radius * d.y, static_cast<double>(1 - row)}, {-d.x, -d.y, 0}};
  });
  return surface;
}

}  // namespace afm::generate
