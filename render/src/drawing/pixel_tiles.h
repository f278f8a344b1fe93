// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "device/vulkan.h"
#include "drawing/pixel_area.h"

namespace afm::render {

// Part of a picture covered by rectangles, in square tiles, at most 64 in each direction. Allocates nothing.
class PixelTiles {
 public:
  explicit PixelTiles(vk::Extent2D extent);

  // Adds every tile that has a pixel of the box.
  void add(const PixelBox& box);
  void add(const PixelArea& area);

  // Tiles combined into a few rectangles, split where that leaves out most of the space in between.
  PixelArea area() const;

 private:
  struct Part {
    glm::ivec2 low{0}, high{0};  // range in tiles; empty if it has no width
  };
  struct Cut {
    int saved_px = 0;
    Part first, second;
  };
  Part tightened(const Part& part) const;
  Cut best_cut(const Part& part) const;
  int pixels(const Part& part) const;

  static constexpr int kMost = 64;
  vk::Extent2D extent_;
  int side_px_;
  std::array<std::uint64_t, kMost> rows_{};  // bit x of element y: tile x, y
  bool everything_ = false;
};

}  // namespace afm::render
