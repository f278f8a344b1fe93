// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "scene/shared/shared_blocks.h"
#include "support/paper_model.h"

// Surfaces of many shapes, for tests that need no files.
namespace afm::test {

// Smooth hills of `height_m` on a patch as wide as gold's, a step of `step_m` across it, and 0 at the origin.
inline scene::SharedHeightField rough_surface(std::uint32_t seed, double height_m = 2e-9, double step_m = 1e-9,
                                              std::uint32_t side = 91, double spacing_m = 0.5e-9) {
  scene::SharedHeightField field;
  field.columns = field.rows = side;
  field.spacing_m = spacing_m;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> phase(0.0, 6.28), wave(4.0, 15.0);
  struct Wave {
    double x, y, phase;
  };
  Wave waves[6];
  for (Wave& w : waves) w = {6.28 / (wave(random) * spacing_m), 6.28 / (wave(random) * spacing_m), phase(random)};
  const auto height = [&](double x, double y) {
    double sum = 0;
    for (const Wave& w : waves) sum += std::sin(w.x * x + w.phase) * std::cos(w.y * y) / 6.0;
    return height_m * sum + (x + 0.3 * y > 5.0 * spacing_m ? step_m : 0.0);
  };
  const double zero = height(0.0, 0.0);
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const double x = (column - 0.5 * (side - 1)) * spacing_m, y = (row - 0.5 * (side - 1)) * spacing_m;
      field.height_m[row * side + column] = static_cast<float>(height(x, y) - zero);
    }
  }
  return field;
}

// Model with the paper's three materials on a surface that is nowhere flat.
inline scene::SharedModel rough_model() {
  scene::SharedModel model = paper_model();
  model.height_field_count = 1;
  model.height_fields[0] = rough_surface(7);
  for (std::uint32_t i = 0; i < model.material_count; ++i) model.materials[i].height_field = 0;
  return model;
}

}  // namespace afm::test
