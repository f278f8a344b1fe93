// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "models.h"

namespace afm::generate {
namespace {

// Lengths in metres of the exhibit: x right, y up, z towards the viewer; the floor is at y = 0, the wall at z = 0.
constexpr double kBack = 4.2, kBeside = 3.4;  // extent within which the edge has dissolved into the background
constexpr double kFront = 0.80;               // extent in front of the wall: below the shelf, no farther into the room
constexpr double kFrontBeside = 1.25;         // extent to the sides, so that no object in front of the wall is cut off
constexpr int kRings = 10;

// The soft shade of the stage, which ends in the floor, wider away from the key light: the floor takes no other.
double shade(double x, double z) {
  constexpr double kHalfWidth = 0.66, kFoot = 0.40, kRear = -0.75, kDarkest = 0.08;
  const double beside = std::max({0.0, x - kHalfWidth, -x - kHalfWidth}),
               before = std::max({0.0, z - kFoot, kRear - z});
  const double reach = x > 0 ? 1.15 : 0.75;
  const double away = std::sqrt(beside * beside / (reach * reach) + before * before / 0.36);
  return mix(kDarkest, 1, smooth_step(0, 1, away));
}

double visible(double x, double z) {
  const double behind = std::max(0.0, -z) / kBack, beside = x / kBeside;
  const double back = 1 - smooth_step(0.25, 1, std::sqrt(behind * behind + beside * beside));
  const double toward = std::max(0.0, z) / kFront, aside = z > 0 ? std::abs(x) / kFrontBeside : 0.0;
  return back * (1 - smooth_step(0.82, 1, toward)) * (1 - smooth_step(0.0, 0.25, z) * smooth_step(0.7, 1, aside));
}

// Finest about the middle of the objects on it.
Surface floor_surface() {
  Surface surface;
  const auto spread = [](std::size_t i, double low, double high) {
    const double t = 2.0 * static_cast<double>(i) / (2 * kRings) - 1;  // place from one edge to the other, -1 to 1
    const double bent = t * (0.35 + 0.65 * t * t);
    return bent < 0 ? -bent * low : bent * high;
  };
  surface.add_grid(2 * kRings + 1, 2 * kRings + 1, [&](std::size_t row, std::size_t column) {
    const double x = spread(column, -kBeside, kBeside), z = spread(2 * kRings - row, -kBack, kFront);
    const double lit = shade(x, z);
    return SurfaceVertex{{x, 0, z}, {0, 1, 0}, {lit, lit, lit}, visible(x, z)};
  });
  return surface;
}

}  // namespace

Model room() {
  Model model{"room", {}};
  model.nodes.push_back({.name = "floor",
                         .parts = {{floor_surface(),
                                    {.name = "floor",
                                     .base_color = {0.040, 0.045, 0.056},
                                     .roughness = 0.62,
                                     .fading = true,
                                     .vertex_colors = true}}}});
  return model;
}

}  // namespace afm::generate
