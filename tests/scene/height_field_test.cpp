// SPDX-License-Identifier: Apache-2.0
// Invariant: the felt surface is the drawn one, vertex by vertex
#include "scene/graph/height_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/gltf/gltf_loader.h"
#include "support/places.h"

namespace afm::scene {
namespace height_field_test {

class DrawnSample : public testing::TestWithParam<std::string> {
 protected:
  Scene scene_ = load_gltf(support::source("assets/models/sample-") + GetParam() + ".glb").value();
  NodeIndex surface_ = scene_.find_node("surface").value();

  std::vector<Primitive>& primitives() { return scene_.meshes[*scene_.nodes[surface_].mesh].primitives; }
};

TEST_P(DrawnSample, IsFeltFromTheVerticesThatAreDrawn) {
  const auto field = height_field_below(scene_, surface_);
  ASSERT_TRUE(field);
  const std::vector<Vertex>& drawn = primitives().front().vertices;
  ASSERT_EQ(std::size_t{field->columns} * field->rows, drawn.size());
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double column = static_cast<double>(i % field->columns), row = static_cast<double>(i / field->columns);
    EXPECT_EQ(field->height_m[i], drawn[i].position.z);
    EXPECT_NEAR((column - 0.5 * (field->columns - 1)) * field->spacing_m, drawn[i].position.x, 1e-3 * field->spacing_m);
    EXPECT_NEAR((row - 0.5 * (field->rows - 1)) * field->spacing_m, drawn[i].position.y, 1e-3 * field->spacing_m);
  }
}

TEST_P(DrawnSample, IsSeenFromAboveWhereItsVerticesAreNoGrid) {
  const SharedHeightField grid = height_field_below(scene_, surface_).value();
  // the walls first: their vertices are no grid of heights
  std::swap(primitives().front(), primitives().back());
  const auto seen = height_field_below(scene_, surface_);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->columns, kMaxHeightFieldSide);
  const float kStrip = GetParam() == std::string("mica") ? 2e-10F : 2e-12F;
  const double half = 0.5 * (grid.columns - 1) * grid.spacing_m;
  for (std::uint32_t row = 1; row + 1 < seen->rows; ++row) {
    for (std::uint32_t column = 1; column + 1 < seen->columns; ++column) {
      const double u = ((column * seen->spacing_m) - 64.0 * seen->spacing_m + half) / grid.spacing_m;
      const double v = ((row * seen->spacing_m) - 64.0 * seen->spacing_m + half) / grid.spacing_m;
      const auto c = static_cast<std::uint32_t>(std::clamp(u, 0.0, grid.columns - 2.0));
      const auto r = static_cast<std::uint32_t>(std::clamp(v, 0.0, grid.rows - 2.0));
      // a triangle lies between the corners of its square, the strip along a step of mica has its own, 0.05 nm higher
      const auto at = [&](std::uint32_t i, std::uint32_t k) { return grid.height_m[k * grid.columns + i]; };
      const auto [low, high] = std::minmax({at(c, r), at(c + 1, r), at(c, r + 1), at(c + 1, r + 1)});
      const float height = seen->height_m[row * seen->columns + column];
      ASSERT_GE(height, low - 2e-12F) << column << ", " << row;
      ASSERT_LE(height, high + kStrip) << column << ", " << row;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Papers, DrawnSample, testing::Values("mica", "gold", "si3n4"),
                         [](const auto& test) { return test.param; });

// One triangle below a node that is turned and raised.
Scene single_triangle(const glm::dmat4& root_from_child) {
  Scene scene;
  Primitive primitive;
  for (const glm::vec3& corner : {glm::vec3(-2e-9F, -2e-9F, 0), glm::vec3(2e-9F, -2e-9F, 0), glm::vec3(0, 2e-9F, 0)}) {
    primitive.vertices.push_back({.position = corner});
  }
  primitive.indices = {0, 1, 2};
  scene.meshes.push_back({"triangle", {primitive}});
  scene.nodes.push_back({.name = "root", .parent = {}, .mesh = {}});
  scene.nodes.push_back({.name = "child", .parent = 0U, .mesh = 0U, .parent_from_node = root_from_child});
  return scene;
}

TEST(HeightField, TakesWhatIsBelowInTheFrameOfTheRoot) {
  glm::dmat4 raised(1.0);
  raised[3] = glm::dvec4(0.0, 0.0, 5e-9, 1.0);
  const auto field = height_field_below(single_triangle(raised), 0);
  ASSERT_TRUE(field);
  EXPECT_NEAR(field->spacing_m, 4e-9 / 128, 1e-15);
  EXPECT_FLOAT_EQ(field->height_m[64 * 129 + 64], 5e-9F);
}

TEST(HeightField, OfNothingIsNone) {
  EXPECT_FALSE(height_field_below(single_triangle(glm::dmat4(0.0)), 0));
  Scene empty;
  empty.nodes.push_back({.name = "root", .parent = {}, .mesh = {}});
  EXPECT_FALSE(height_field_below(empty, 0));
}

}  // namespace height_field_test
}  // namespace afm::scene
