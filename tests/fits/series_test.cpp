// SPDX-License-Identifier: Apache-2.0
#include "series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

namespace afm::fits {
namespace series_test {

// Soft and stiff samples, near the contact point and deep, from any start.
TEST(PressedLever, IsInSeriesWithEachShape) {
  constexpr double kSpring = 0.05;
  for (const ShapeRow& row : kShapes) {
    if (row.is_adhesive || row.is_exact) continue;
    const Indenter tip{.shape = row.shape,
                       .radius_m = row.has_radius ? 5e-6 : 0.0,
                       .half_angle_rad = row.has_radius ? 0.0 : 0.4,
                       .layer_m = row.has_layer ? 8e-6 : 0.0,
                       .table = {}};
    for (const double modulus_pa : {1.0, 4e3, 1e7, 1e12}) {
      const PressedLever lever(tip, modulus_pa, kSpring);
      for (const double way_m : {1e-13, 1e-9, 1e-6}) {
        for (const double start : {1e-3, 0.1, 1.0}) {
          const PressedLever::Four ways{Two{way_m, 0.7 * way_m}, Two{0.1 * way_m, 0.95 * way_m}};
          const double root = start * std::sqrt(way_m);
          PressedLever::Four roots{Two{root, root}, Two{root, root}};
          PressedLever::Pressed pressed;
          lever.at(ways, roots, pressed);
          for (const std::size_t pair : {0U, 1U}) {
            for (const int i : {0, 1}) {
              const double depth_m = pressed.depth_m[pair][i], force_n = pressed.force_n[pair][i];
              const double way = ways[pair][i];
              EXPECT_NEAR(depth_m + force_n / kSpring, way, 1e-9 * way) << row.name << ", " << modulus_pa;
              const Push push = push_of(tip, depth_m);
              EXPECT_NEAR(force_n, modulus_pa * push.force, 1e-6 * force_n) << row.name << ", " << modulus_pa;
              EXPECT_NEAR(pressed.slope_n_per_m[pair][i], modulus_pa * push.slope, 1e-6 * modulus_pa * push.slope);
            }
          }
        }
      }
    }
  }
}

}  // namespace series_test
}  // namespace afm::fits
