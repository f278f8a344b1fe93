// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "render/frame.h"

namespace afm::render {

// The colour grids of all panels painted in a frame, side by side in one picture, each with a rim that repeats its
// outermost cells, so that filtering never blends two grids. Keeps its memory.
class GridSheet {
 public:
  static constexpr std::uint32_t kWidth = 1024;  // texels
  static_assert(kWidth >= 2 * (kMostGridCells + 2));

  struct Place {
    glm::vec2 from{0.0F}, to{0.0F};  // corners of the cells, in texels
    std::uint32_t digest = 0;        // hash of the colours, sometimes the only difference between paintings
  };

  void clear();

  // Adds a grid; one of more than kMostGridCells in a direction is a bug of ours.
  Place add(const ColorGrid& grid);

  bool empty() const { return texels_.empty(); }
  std::uint32_t height() const { return static_cast<std::uint32_t>(texels_.size() / kWidth); }
  std::span<const std::array<std::uint8_t, 4>> texels() const { return texels_; }  // texels row by row

 private:
  glm::uvec2 next_{0};            // corner of the rim of the next grid
  std::uint32_t row_bottom_ = 0;  // lower end of the row of grids that is being filled
  std::vector<std::array<std::uint8_t, 4>> texels_;
};

}  // namespace afm::render
