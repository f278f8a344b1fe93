// SPDX-License-Identifier: Apache-2.0
#include "scene/display/warp_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace afm::scene {

namespace {

constexpr std::uint32_t kMostLines = 32;  // visible mesh lines in each direction
constexpr double kOnEdge = 1e-9;          // in barycentric coordinates: neighbours share the points on their edge

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Half of a cell. Its edges from corner 0 to 1 and from corner 1 to 2 are lines of the mesh.
struct MeshTriangle {
  std::array<const WarpNode*, 3> corners;

  // Barycentric coordinates of a point; nothing outside.
  std::optional<std::array<double, 3>> shares(const glm::dvec2& place) const {
    const glm::dvec2 a = corners[0]->output, ab = corners[1]->output - a, ac = corners[2]->output - a;
    const double area = cross(ab, ac);
    const double second = cross(place - a, ac) / area, third = cross(ab, place - a) / area;
    const std::array found{1.0 - second - third, second, third};
    if (!(std::min({found[0], found[1], found[2]}) >= -kOnEdge)) return std::nullopt;
    return found;
  }

  WarpedPlace at(const std::array<double, 3>& shares) const {
    WarpedPlace place{.intensity = 0.0};
    for (std::size_t i = 0; i < shares.size(); ++i) {
      place.picture += shares.at(i) * corners.at(i)->picture;
      place.intensity += shares.at(i) * corners.at(i)->intensity;
    }
    return place;
  }
};

// Triangles of a cell, the one along its upper and right edge first; none if a corner is not drawn.
std::array<std::optional<MeshTriangle>, 2> triangles_of(const WarpMesh& mesh, std::uint32_t column, std::uint32_t row) {
  const WarpNode* const first = &mesh.node(column, row);
  const WarpNode* const right = &mesh.node(column + 1, row);
  const WarpNode* const opposite = &mesh.node(column + 1, row + 1);
  const WarpNode* const below = &mesh.node(column, row + 1);
  for (const WarpNode* node : {first, right, opposite, below}) {
    if (node->intensity < 0.0) return {};
  }
  return {MeshTriangle{{first, right, opposite}}, MeshTriangle{{opposite, below, first}}};
}

// True if the mesh shows the line number `line`: about kMostLines lines, including the last.
bool is_shown_line(std::uint32_t line, std::uint32_t lines) {
  const std::uint32_t step = (lines - 1 + kMostLines - 1) / kMostLines;
  return line % step == 0 || line + 1 == lines;
}

// Distance in pixels from a point to the straight line through two others.
double distance_px(const glm::dvec2& place, const glm::dvec2& from, const glm::dvec2& to) {
  return std::abs(cross(to - from, place - from)) / glm::length(to - from);
}

struct WarpRaster {
  glm::uvec2 size_px;
  std::vector<glm::vec4> pixels;

  // `lines` is true for the visible edges: from corner 0 to 1, and from 1 to 2.
  void draw(const MeshTriangle& triangle, const std::array<bool, 2>& lines) {
    const glm::dvec2 size(size_px);
    std::array<glm::dvec2, 3> corners_px{};
    glm::dvec2 low(size), high(0.0);
    for (std::size_t i = 0; i < corners_px.size(); ++i) {
      corners_px.at(i) = triangle.corners.at(i)->output * size;
      low = glm::min(low, corners_px.at(i));
      high = glm::max(high, corners_px.at(i));
    }
    const glm::uvec2 begin(glm::clamp(glm::floor(low - 0.5), glm::dvec2(0.0), size));
    const glm::uvec2 end(glm::clamp(glm::ceil(high + 0.5), glm::dvec2(0.0), size));
    for (std::uint32_t y = begin.y; y < end.y; ++y) {
      for (std::uint32_t x = begin.x; x < end.x; ++x) {
        const glm::dvec2 middle_px = glm::dvec2(x, y) + 0.5;
        const auto shares = triangle.shares(middle_px / size);
        if (!shares) continue;
        double nearest_px = size.x + size.y;
        for (std::size_t i = 0; i < lines.size(); ++i) {
          if (!lines.at(i)) continue;
          nearest_px = std::min(nearest_px, distance_px(middle_px, corners_px.at(i), corners_px.at(i + 1)));
        }
        const WarpedPlace place = triangle.at(*shares);
        pixels[std::size_t{y} * size_px.x + x] =
            glm::vec4(glm::dvec4(place.picture, place.intensity, 1.0 + nearest_px));
      }
    }
  }
};

}  // namespace

std::optional<WarpedPlace> warped_place(const WarpMesh& mesh, const glm::dvec2& output) {
  for (std::uint32_t row = 0; row + 1 < mesh.rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < mesh.columns; ++column) {
      for (const auto& triangle : triangles_of(mesh, column, row)) {
        if (!triangle) break;
        if (const auto shares = triangle->shares(output)) return triangle->at(*shares);
      }
    }
  }
  return std::nullopt;
}

std::vector<glm::vec4> warp_map(const WarpMesh& mesh, const glm::uvec2& size_px) {
  WarpRaster raster{size_px, std::vector<glm::vec4>(std::size_t{size_px.x} * size_px.y, glm::vec4(0.0F))};
  for (std::uint32_t row = 0; row + 1 < mesh.rows; ++row) {
    const bool above = is_shown_line(row, mesh.rows), below = is_shown_line(row + 1, mesh.rows);
    for (std::uint32_t column = 0; column + 1 < mesh.columns; ++column) {
      const auto triangles = triangles_of(mesh, column, row);
      if (!triangles[0]) continue;
      const bool left = is_shown_line(column, mesh.columns), right = is_shown_line(column + 1, mesh.columns);
      raster.draw(*triangles[0], {above, right});
      raster.draw(*triangles[1], {below, left});
    }
  }
  return std::move(raster.pixels);
}

}  // namespace afm::scene
