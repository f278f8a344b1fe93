// SPDX-License-Identifier: Apache-2.0
#include "exhibit/models/relief.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>

#include "core/check.h"
#include "exhibit/models/height_colours.h"
#include "models/linear_colour.h"

namespace afm::exhibit {

namespace {

constexpr double kSunkOfSide = 0.25;  // depth of the floor below the lowest colour, inside any sample's slab
constexpr int kColours = 256;

double middle_of(std::size_t cell) { return (static_cast<double>(cell) + 0.5) / kReliefSide - 0.5; }

// Rise per cell along a row or a column, from the neighbours that have been measured.
double rise(const std::optional<double>& before, double here, const std::optional<double>& after) {
  if (before && after) return 0.5 * (*after - *before);
  if (after) return *after - here;
  return before ? here - *before : 0.0;
}

}  // namespace

scene::Scene relief_mesh() {
  scene::Primitive grid;
  for (std::size_t row = 0; row < kReliefSide; ++row) {
    for (std::size_t column = 0; column < kReliefSide; ++column) {
      grid.vertices.push_back(
          {{static_cast<float>(middle_of(column)), static_cast<float>(-middle_of(row)), 0.0F}, {0.0F, 0.0F, 1.0F}});
    }
  }
  grid.vertices.back().position.z = 1.0F;  // height of the box of all shapes
  constexpr auto kSide = static_cast<std::uint32_t>(kReliefSide);
  for (std::uint32_t row = 0; row + 1 < kSide; ++row) {
    for (std::uint32_t column = 0; column + 1 < kSide; ++column) {
      const std::uint32_t first = row * kSide + column, below = first + kSide;
      grid.indices.insert(grid.indices.end(), {first, below, below + 1, first, below + 1, first + 1});
    }
  }
  scene::Scene relief;
  relief.materials.push_back({.name = "false colours", .metallic = 0.0F, .roughness = 0.55F});
  relief.meshes.push_back({"relief", {std::move(grid)}});
  relief.nodes.push_back({.name = "relief", .parent = std::nullopt, .mesh = 0U, .reshaped = true});
  return relief;
}

HeightRelief relief_of(std::span<const double> height_m, double side_m, const ReliefScale& scale) {
  AFM_CHECK(height_m.size() == kReliefSide * kReliefSide);
  HeightRelief relief;
  relief.side_m = scale.lateral * side_m;
  relief.range_m = scale.high_m - scale.low_m;
  relief.floor_m = scale.vertical * scale.low_m - kSunkOfSide * relief.side_m;
  relief.lid_m = scale.vertical * scale.high_m + kSunkOfSide * relief.side_m;
  const auto unit = [&](double measured_m) {
    return std::clamp((scale.vertical * measured_m - relief.floor_m) / (relief.lid_m - relief.floor_m), 0.0, 1.0);
  };
  const auto at = [&](std::size_t column, std::size_t row) -> std::optional<double> {
    if (column >= kReliefSide || row >= kReliefSide)
      return std::nullopt;  // no place; includes points beyond the lower rims, by wrapping
    const double measured_m = height_m[row * kReliefSide + column];
    return std::isfinite(measured_m) ? std::optional(unit(measured_m)) : std::nullopt;
  };
  std::vector<glm::vec4> colours;
  colours.reserve(kColours);
  for (int i = 0; i < kColours; ++i) colours.push_back(linear_colour(height_colour(i / (kColours - 1.0))));
  relief.vertices.reserve(height_m.size());
  for (std::size_t row = 0; row < kReliefSide; ++row) {
    for (std::size_t column = 0; column < kReliefSide; ++column) {
      scene::Vertex& vertex = relief.vertices.emplace_back();
      const std::optional<double> here = at(column, row);
      vertex.position = {static_cast<float>(middle_of(column)), static_cast<float>(-middle_of(row)),
                         static_cast<float>(here.value_or(0.0))};
      if (!here) {
        vertex.color = linear_colour(kNoHeightColour);
        continue;
      }
      const double along_x = rise(at(column - 1, row), *here, at(column + 1, row)),
                   along_y = rise(at(column, row + 1), *here, at(column, row - 1));
      vertex.normal = glm::vec3(glm::normalize(glm::dvec3(-along_x * kReliefSide, -along_y * kReliefSide, 1.0)));
      const double share = (height_m[row * kReliefSide + column] - scale.low_m) / relief.range_m;
      vertex.color = colours[static_cast<std::size_t>(std::lround((kColours - 1) * std::clamp(share, 0.0, 1.0)))];
    }
  }
  return relief;
}

}  // namespace afm::exhibit
