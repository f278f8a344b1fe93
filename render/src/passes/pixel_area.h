// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>

#include "device/vulkan.h"

namespace afm::render {

// A rectangle of pixels; `high` lies outside it. Empty where it has no width or no height.
struct PixelBox {
  glm::ivec2 low{0}, high{0};

  bool operator==(const PixelBox&) const = default;

  bool empty() const { return high.x <= low.x || high.y <= low.y; }
  std::int64_t pixels() const;
  PixelBox within(const PixelBox& other) const;  // what both have
  PixelBox with(const PixelBox& other) const;    // the smallest that has both; an empty one has nothing to add
  vk::Rect2D rect() const;                       // low is not negative

  static PixelBox whole(vk::Extent2D extent);
};

// A part of a picture: all of it, or a few rectangles that do not overlap, so that one may be written after another
// without a barrier. PixelTiles finds them. Allocates nothing.
class PixelArea {
 public:
  static constexpr std::size_t kMostBoxes = 12;
  static constexpr std::int64_t kPixelsOfBox = 8192;  // work that a rectangle of its own costs, in pixels

  PixelArea() = default;

  // At most kMostBoxes, of which no two overlap.
  explicit PixelArea(std::span<const PixelBox> boxes);

  void add_everything();
  PixelArea within(const PixelBox& box) const;  // everything stays everything

  bool everything() const { return everything_; }
  bool empty() const { return !everything_ && count_ == 0; }

  // Unless it is everything.
  std::span<const PixelBox> boxes() const { return {boxes_.data(), count_}; }
  PixelBox around() const;                     // the smallest that has all of them
  double share_of(vk::Extent2D extent) const;  // at most 1

 private:
  std::array<PixelBox, kMostBoxes> boxes_;
  std::size_t count_ = 0;
  bool everything_ = false;
};

}  // namespace afm::render
