// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace afm::scene {

// Node of a mesh that bends an output's picture for a curved screen. Both points are in unit coordinates from the upper
// left corner: `output` in the projector's picture, possibly outside it, `picture` in the flat picture.
struct WarpNode {
  glm::dvec2 output{0.0};
  glm::dvec2 picture{0.0};
  double intensity = 1;  // factor for the encoded colour, 0 to 1; negative: area around the node is blank
};

// Grid of nodes, row by row. Each cell consists of two triangles, over which positions and intensity are linear; the
// diagonal goes through the cell's first node. Neither folds nor mirrors the picture.
struct WarpMesh {
  std::uint32_t columns = 0, rows = 0;
  std::vector<WarpNode> nodes;

  const WarpNode& node(std::uint32_t column, std::uint32_t row) const {
    return nodes[std::size_t{row} * columns + column];
  }
};

inline constexpr std::uint32_t kMostMeshNodes = 512;  // nodes in each direction

// Reads and checks a mesh in the text format of P. Bourke ("Mesh format for image warping", 2006), of type 2. x ranges
// from -aspect to aspect: `aspect` is that of the output or, if unknown, the mesh's largest x. The error names file and
// line.
core::Result<WarpMesh> load_warp_mesh(const std::string& path, std::optional<double> aspect);

// Content of an output at a point; nothing if no cell is drawn there.
struct WarpedPlace {
  glm::dvec2 picture{0.0};
  double intensity = 1;
};
std::optional<WarpedPlace> warped_place(const WarpMesh& mesh, const glm::dvec2& output);

// Same for the centre of each pixel of an output of that size, row by row. xy: picture point; z: intensity; w: 0 if
// nothing is drawn, else 1 + the distance in pixels from the nearest visible line of the mesh. A dense mesh shows only
// some of its lines.
std::vector<glm::vec4> warp_map(const WarpMesh& mesh, const glm::uvec2& size_px);

}  // namespace afm::scene
