// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/volume_shapes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "models/linear_colour.h"

namespace afm::exhibit {

namespace {

constexpr Srgb kPullColour{43, 131, 203}, kNoForceColour{176, 182, 188}, kPushColour{224, 112, 20};
constexpr std::size_t kBarSteps = 64;

// A grid of columns x rows vertices, row by row, seen from both sides.
scene::Primitive two_sided_grid(std::size_t columns, std::size_t rows) {
  scene::Primitive grid;
  grid.vertices.resize(columns * rows);
  grid.indices.reserve(6 * (columns - 1) * (rows - 1));
  for (std::size_t row = 0; row + 1 < rows; ++row) {
    for (std::size_t column = 0; column + 1 < columns; ++column) {
      const auto first = static_cast<std::uint32_t>(row * columns + column),
                 above = first + static_cast<std::uint32_t>(columns);
      grid.indices.insert(grid.indices.end(), {first, first + 1, above + 1, first, above + 1, above});
    }
  }
  return grid;
}

scene::Scene reshaped_part(const char* name, scene::Primitive primitive, const scene::PbrMaterial& material) {
  scene::Scene part;
  part.materials.push_back(material);
  part.meshes.push_back({name, {std::move(primitive)}});
  part.nodes.push_back({.name = name, .parent = std::nullopt, .mesh = 0U, .reshaped = true});
  return part;
}

}  // namespace

Srgb force_colour(double share) {
  const double strength = std::fmin(std::abs(share), 1.0);
  const Srgb& end = share < 0.0 ? kPullColour : kPushColour;
  Srgb colour{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    const double none = kNoForceColour[i], most = end[i];
    colour[i] = static_cast<std::uint8_t>(std::lround(none + strength * (most - none)));
  }
  return colour;
}

scene::Scene slice_mesh() {
  scene::Primitive grid = two_sided_grid(kSliceColumns, kSliceRows);
  for (std::size_t row = 0; row < kSliceRows; ++row) {
    for (std::size_t column = 0; column < kSliceColumns; ++column) {
      scene::Vertex& vertex = grid.vertices[row * kSliceColumns + column];
      vertex.position = {static_cast<float>(column) / (kSliceColumns - 1) - 0.5F, 0.0F,
                         static_cast<float>(row) / (kSliceRows - 1)};
      vertex.normal = {0.0F, -1.0F, 0.0F};
    }
  }
  return reshaped_part("slice", std::move(grid),
                       {.name = "forces", .metallic = 0.0F, .double_sided = true, .blended = true, .unlit = true});
}

std::vector<scene::Vertex> force_bar_vertices(double width) {
  std::vector<scene::Vertex> vertices;
  vertices.reserve(2 * (kBarSteps + 1));
  for (std::size_t i = 0; i <= kBarSteps; ++i) {
    const double height = static_cast<double>(i) / kBarSteps;
    for (const double x : {0.0, width}) {
      vertices.push_back({{static_cast<float>(x), 0.0F, static_cast<float>(height)},
                          {0.0F, -1.0F, 0.0F},
                          linear_colour(force_colour(2.0 * height - 1.0))});
    }
  }
  return vertices;
}

scene::Scene force_bar(double width) {
  scene::Primitive strip = two_sided_grid(2, kBarSteps + 1);
  strip.vertices = force_bar_vertices(width);
  return reshaped_part("bar", std::move(strip),
                       {.name = "force colours", .metallic = 0.0F, .double_sided = true, .unlit = true});
}

scene::Scene equal_force_mesh() {
  scene::Primitive grid = two_sided_grid(kSurfaceSide, kSurfaceSide);
  for (std::size_t row = 0; row < kSurfaceSide; ++row) {
    for (std::size_t column = 0; column < kSurfaceSide; ++column) {
      grid.vertices[row * kSurfaceSide + column].position = {static_cast<float>(column) / (kSurfaceSide - 1) - 0.5F,
                                                             static_cast<float>(row) / (kSurfaceSide - 1) - 0.5F, 0.0F};
    }
  }
  grid.vertices.back().position.z = 1.0F;  // height of the box of all shapes
  return reshaped_part(
      "surface", std::move(grid),
      {.name = "equal force", .metallic = 0.0F, .roughness = 0.5F, .double_sided = true, .blended = true});
}

}  // namespace afm::exhibit
