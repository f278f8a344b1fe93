// SPDX-License-Identifier: Apache-2.0
// Invariant: reordering a mesh for the vertex cache neither loses nor flips a triangle
#include "drawing/mesh_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace afm::render {
namespace mesh_order_test {

// A grid of `side` by `side` cells, row by row, like a height field, and an unused vertex.
scene::Primitive grid(std::uint32_t side) {
  scene::Primitive primitive;
  const std::uint32_t across = side + 1;
  for (std::uint32_t i = 0; i < across * across; ++i) {
    primitive.vertices.push_back({.position = {static_cast<float>(i % across), 0.0F, static_cast<float>(i / across)}});
  }
  primitive.vertices.push_back({.position = {-1.0F, -1.0F, -1.0F}});
  for (std::uint32_t row = 0; row < side; ++row) {
    for (std::uint32_t column = 0; column < side; ++column) {
      const std::uint32_t corner = row * across + column;
      for (const std::uint32_t index :
           {corner, corner + across, corner + 1, corner + 1, corner + across, corner + across + 1}) {
        primitive.indices.push_back(index);
      }
    }
  }
  return primitive;
}

using Triangle = std::array<std::uint32_t, 3>;

// Triangles with the primitive's own vertices, each from its smallest on, so that the winding stays.
std::vector<Triangle> triangles(const MeshOrder& order) {
  std::vector<Triangle> found;
  for (std::size_t i = 0; i + 2 < order.indices.size(); i += 3) {
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = order.vertices.at(order.indices[i + k]);
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    found.push_back(t);
  }
  std::sort(found.begin(), found.end());
  return found;
}

MeshOrder as_given(const scene::Primitive& primitive) {
  MeshOrder order{.vertices = {}, .indices = primitive.indices};
  for (std::uint32_t i = 0; i < primitive.vertices.size(); ++i) order.vertices.push_back(i);
  return order;
}

// Number of vertices shaded by a device that remembers the newest `size` of them.
std::size_t shaded(const std::vector<std::uint32_t>& indices, std::size_t size) {
  std::vector<std::uint32_t> newest;
  std::size_t count = 0;
  for (const std::uint32_t index : indices) {
    if (std::find(newest.begin(), newest.end(), index) != newest.end()) continue;
    ++count;
    newest.push_back(index);
    if (newest.size() > size) newest.erase(newest.begin());
  }
  return count;
}

TEST(MeshOrder, KeepsEveryTriangleAndItsWinding) {
  const scene::Primitive primitive = grid(64);
  EXPECT_EQ(triangles(drawing_order(primitive, false)), triangles(as_given(primitive)));
}

TEST(MeshOrder, LeavesOutWhatNoTriangleUses) {
  const scene::Primitive primitive = grid(8);
  const MeshOrder order = drawing_order(primitive, false);
  EXPECT_EQ(order.vertices.size(), primitive.vertices.size() - 1);
  EXPECT_EQ(std::count(order.vertices.begin(), order.vertices.end(), primitive.vertices.size() - 1), 0);
}

TEST(MeshOrder, ShadesFewVerticesTwice) {
  const scene::Primitive primitive = grid(64);
  const auto vertices = static_cast<double>(primitive.vertices.size());
  EXPECT_GT(static_cast<double>(shaded(primitive.indices, 16)), 1.9 * vertices);
  EXPECT_LT(static_cast<double>(shaded(drawing_order(primitive, false).indices, 16)), 1.5 * vertices);
}

TEST(MeshOrder, LiesInTheOrderOfUse) {
  const MeshOrder order = drawing_order(grid(16), false);
  ASSERT_FALSE(order.indices.empty());
  std::uint32_t next = 0;
  for (const std::uint32_t index : order.indices) {
    ASSERT_LE(index, next);
    if (index == next) ++next;
  }
  EXPECT_GT(next, 16U * 16U);
}

TEST(MeshOrder, LeavesWhatBlendsAndWhatIsNoTrianglesAlone) {
  scene::Primitive primitive = grid(8);
  EXPECT_EQ(drawing_order(primitive, true).indices, primitive.indices);
  primitive.topology = scene::Topology::Lines;
  const MeshOrder order = drawing_order(primitive, false);
  EXPECT_EQ(order.indices, primitive.indices);
  EXPECT_EQ(order.vertices, as_given(primitive).vertices);
}

}  // namespace mesh_order_test
}  // namespace afm::render
