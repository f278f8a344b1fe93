// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "device/vulkan.h"

namespace afm::render {

// Rectangle of pixels; `high` is exclusive. Empty if it has no width or no height.
struct PixelBox {
  glm::ivec2 low{0}, high{0};

  bool operator==(const PixelBox&) const = default;

  bool empty() const { return high.x <= low.x || high.y <= low.y; }
  std::int64_t pixels() const;
  PixelBox within(const PixelBox& other) const;  // intersection of both boxes
  PixelBox with(const PixelBox& other) const;    // bounding box of both; an empty box adds nothing
  vk::Rect2D rect() const;                       // requires non-negative `low`

  static PixelBox whole(vk::Extent2D extent);
};

// Part of a picture: all of it, or a few rectangles that do not overlap, so that they can be written one after another
// without a barrier. Created by PixelTiles. Allocates nothing.
class PixelArea {
 public:
  static constexpr std::size_t kMostBoxes = 12;
  static constexpr std::int64_t kPixelsOfBox = 8192;  // cost of one more rectangle, in pixels of work

  PixelArea() = default;

  // Takes at most kMostBoxes boxes, none of which overlap.
  explicit PixelArea(std::span<const PixelBox> boxes);

  void add_everything();
  PixelArea within(const PixelBox& box) const;  // intersection; everything stays everything

  bool everything() const { return everything_; }
  bool empty() const { return !everything_ && count_ == 0; }

  // Empty if the area is everything.
  std::span<const PixelBox> boxes() const { return {boxes_.data(), count_}; }
  PixelBox around() const;                     // bounding box of all boxes
  double share_of(vk::Extent2D extent) const;  // fraction of a picture of that size, at most 1

 private:
  std::array<PixelBox, kMostBoxes> boxes_;
  std::size_t count_ = 0;
  bool everything_ = false;
};

}  // namespace afm::render
