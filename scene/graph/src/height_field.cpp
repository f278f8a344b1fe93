// SPDX-License-Identifier: Apache-2.0
#include "scene/graph/height_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/matrix.hpp>
#include <limits>
#include <span>
#include <vector>

namespace afm::scene {

namespace {

// largest distance of a vertex from its grid point, in spacings; positions are floats
constexpr double kOffGrid = 1e-3;

std::optional<SharedHeightField> grid_of(std::span<const Vertex> vertices) {
  const auto x = [&](std::size_t i) { return static_cast<double>(vertices[i].position.x); };
  const auto y = [&](std::size_t i) { return static_cast<double>(vertices[i].position.y); };
  if (vertices.size() < 4) return std::nullopt;
  std::size_t columns = 1;
  while (columns < vertices.size() && x(columns) > x(columns - 1)) ++columns;
  const std::size_t rows = vertices.size() / columns;
  if (columns < 2 || rows < 2 || columns > kMaxHeightFieldSide || rows > kMaxHeightFieldSide ||
      columns * rows != vertices.size()) {
    return std::nullopt;
  }

  SharedHeightField field;
  field.columns = static_cast<std::uint32_t>(columns);
  field.rows = static_cast<std::uint32_t>(rows);
  field.spacing_m = (x(columns - 1) - x(0)) / static_cast<double>(columns - 1);
  const auto coordinate = [&](std::size_t index, std::size_t count) {
    return (static_cast<double>(index) - 0.5 * static_cast<double>(count - 1)) * field.spacing_m;
  };
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const double off =
        std::max(std::abs(x(i) - coordinate(i % columns, columns)), std::abs(y(i) - coordinate(i / columns, rows)));
    if (!(off <= kOffGrid * field.spacing_m)) return std::nullopt;
    field.height_m[i] = vertices[i].position.z;
  }
  return field;
}

using Triangle = std::array<glm::dvec3, 3>;

std::vector<Triangle> triangles_below(const Scene& scene, NodeIndex root) {
  std::vector<Triangle> triangles;
  std::vector<std::optional<glm::dmat4>> root_from_node(scene.nodes.size());
  for (NodeIndex i = root; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (i == root) {
      root_from_node[i] = glm::dmat4(1.0);
    } else if (node.parent && root_from_node[*node.parent]) {
      root_from_node[i] = *root_from_node[*node.parent] * node.parent_from_node;
    }
    if (!root_from_node[i] || !node.mesh) continue;
    for (const Primitive& primitive : scene.meshes[*node.mesh].primitives) {
      if (primitive.topology != Topology::Triangles) continue;
      const auto corner = [&](std::size_t index) {
        return glm::dvec3(*root_from_node[i] *
                          glm::dvec4(glm::dvec3(primitive.vertices[primitive.indices[index]].position), 1.0));
      };
      for (std::size_t k = 0; k + 2 < primitive.indices.size(); k += 3) {
        triangles.push_back({corner(k), corner(k + 1), corner(k + 2)});
      }
    }
  }
  return triangles;
}

// Raises the field to the triangle where the triangle is above it.
void raise_to(const Triangle& t, double half_m, SharedHeightField& field) {
  const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
  if (area == 0.0) return;  // triangle seen edge-on from above
  const auto index = [&](double place_m, double rounding) {
    return static_cast<std::size_t>(
        std::clamp(std::floor((place_m + half_m) / field.spacing_m + rounding), 0.0, field.columns - 1.0));
  };
  const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [front, back] = std::minmax({t[0].y, t[1].y, t[2].y});
  for (std::size_t row = index(front, 0.0); row <= index(back, 1.0); ++row) {
    for (std::size_t column = index(left, 0.0); column <= index(right, 1.0); ++column) {
      const double x = static_cast<double>(column) * field.spacing_m - half_m;
      const double y = static_cast<double>(row) * field.spacing_m - half_m;
      const double b = ((x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (y - t[0].y)) / area;
      const double c = ((t[1].x - t[0].x) * (y - t[0].y) - (x - t[0].x) * (t[1].y - t[0].y)) / area;
      if (b < -kOffGrid || c < -kOffGrid || b + c > 1.0 + kOffGrid) continue;
      float& height = field.height_m[row * field.columns + column];
      height = std::max(height, static_cast<float>(t[0].z + b * (t[1].z - t[0].z) + c * (t[2].z - t[0].z)));
    }
  }
}

}  // namespace

std::optional<SharedHeightField> height_field_below(const Scene& scene, NodeIndex root) {
  if (const auto mesh = scene.nodes[root].mesh; mesh && !scene.meshes[*mesh].primitives.empty()) {
    if (auto grid = grid_of(scene.meshes[*mesh].primitives.front().vertices)) return grid;
  }

  const std::vector<Triangle> triangles = triangles_below(scene, root);
  double half_m = 0.0, lowest_m = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : triangles) {
    for (const glm::dvec3& corner : triangle) {
      half_m = std::max({half_m, std::abs(corner.x), std::abs(corner.y)});
      lowest_m = std::min(lowest_m, corner.z);
    }
  }
  if (!std::isnormal(half_m)) return std::nullopt;
  SharedHeightField field;
  field.columns = field.rows = kMaxHeightFieldSide;
  field.spacing_m = 2.0 * half_m / (kMaxHeightFieldSide - 1);
  field.height_m.fill(static_cast<float>(lowest_m));
  for (const Triangle& triangle : triangles) raise_to(triangle, half_m, field);
  return field;
}

}  // namespace afm::scene
