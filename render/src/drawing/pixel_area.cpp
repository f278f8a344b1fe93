// SPDX-License-Identifier: Apache-2.0
#include "drawing/pixel_area.h"

#include <algorithm>
#include <glm/common.hpp>

#include "core/check.h"

namespace afm::render {

std::int64_t PixelBox::pixels() const { return empty() ? 0 : std::int64_t{high.x - low.x} * (high.y - low.y); }

PixelBox PixelBox::within(const PixelBox& other) const {
  return {glm::max(low, other.low), glm::min(high, other.high)};
}

PixelBox PixelBox::with(const PixelBox& other) const {
  if (empty()) return other;
  if (other.empty()) return *this;
  return {glm::min(low, other.low), glm::max(high, other.high)};
}

vk::Rect2D PixelBox::rect() const {
  return {.offset = {low.x, low.y},
          .extent = {static_cast<std::uint32_t>(high.x - low.x), static_cast<std::uint32_t>(high.y - low.y)}};
}

PixelBox PixelBox::whole(vk::Extent2D extent) {
  return {glm::ivec2(0), glm::ivec2(static_cast<int>(extent.width), static_cast<int>(extent.height))};
}

PixelArea::PixelArea(std::span<const PixelBox> boxes) : count_(boxes.size()) {
  AFM_CHECK(boxes.size() <= kMostBoxes);
  std::copy(boxes.begin(), boxes.end(), boxes_.begin());
}

void PixelArea::add_everything() {
  everything_ = true;
  count_ = 0;
}

PixelArea PixelArea::within(const PixelBox& box) const {
  PixelArea inside;
  inside.everything_ = everything_;
  for (const PixelBox& each : boxes()) {
    const PixelBox both = each.within(box);
    if (!both.empty()) inside.boxes_[inside.count_++] = both;
  }
  return inside;
}

PixelBox PixelArea::around() const {
  PixelBox around;
  for (const PixelBox& box : boxes()) around = around.with(box);
  return around;
}

double PixelArea::share_of(vk::Extent2D extent) const {
  const std::int64_t all = PixelBox::whole(extent).pixels();
  std::int64_t sum = everything_ ? all : 0;
  for (const PixelBox& box : boxes()) sum += box.pixels();
  return std::min(1.0, static_cast<double>(sum) / static_cast<double>(all));
}

}  // namespace afm::render
