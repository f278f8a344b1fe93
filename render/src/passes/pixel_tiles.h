// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "device/vulkan.h"
#include "passes/pixel_area.h"

namespace afm::render {

// The part of a picture that rectangles cover, in square tiles: at most 64 each way. Allocates nothing.
class PixelTiles {
 public:
  explicit PixelTiles(vk::Extent2D extent);

  // Every tile that has a pixel of it.
  void add(const PixelBox& box);
  void add(const PixelArea& area);

  // The tiles in a few rectangles: cut where that leaves out most of what is between them.
  PixelArea area() const;

 private:
  struct Part {
    glm::ivec2 low{0}, high{0};  // in tiles; empty where it has no width
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
  std::array<std::uint64_t, kMost> rows_{};  // bit x of row y
  bool everything_ = false;
};

}  // namespace afm::render
