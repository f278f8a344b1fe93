// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "scene/shared/felt_heights.h"
#include "support/paper_model.h"

namespace afm::test {

// An image as recorded by a microscope: hills and sharp steps with noise at each point, 0 at the origin; metres as
// measured.
inline scene::Topography measured_surface(std::uint32_t side = scene::kMaxTopographySide, double width_m = 10e-6,
                                          double height_m = 1e-6, std::uint32_t seed = 19) {
  scene::Topography topography{.columns = side, .rows = side, .spacing_m = width_m / side, .height_m = {}};
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 0.01);
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const double x = (column + 0.5) / side - 0.5, y = (row + 0.5) / side - 0.5;
      const double hills = 0.4 * std::sin(7.0 * x + 4.0 * y) * std::cos(6.0 * y - 3.0 * x);
      const double steps = 0.3 * std::floor(3.0 * (y + 0.4 * x) + 0.5);
      topography.height_m.push_back(static_cast<float>(height_m * (hills + steps + noise(random))));
    }
  }
  const float origin_m = topography.height_m[(side / 2) * side + side / 2];
  for (float& height : topography.height_m) height -= origin_m;
  return topography;
}

// Scale at which it is some 60 nm wide and in true proportions.
inline constexpr scene::TopographyScale kMeasuredScale{.lateral = 6e-3, .vertical = 6e-3};

// Model with the paper's three materials on that surface.
inline scene::SharedModel measured_model(const scene::Topography& topography) {
  scene::SharedModel model = paper_model();
  model.topography = topography.size();
  for (std::uint32_t i = 0; i < model.material_count; ++i) {
    model.materials[i].height_field = scene::kTopography;
    model.materials[i].topography = kMeasuredScale;
  }
  return model;
}

}  // namespace afm::test
