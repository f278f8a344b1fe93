// SPDX-License-Identifier: Apache-2.0
#include "drawing/pixel_tiles.h"

#include <algorithm>
#include <bit>
#include <glm/common.hpp>
#include <span>

namespace afm::render {
namespace {

// Tile size. Mesa 22.3's lavapipe draws in tiles of 64 x 64 pixels, and a scissor that begins inside one lets through
// some of the samples in the pixels before it.
constexpr int kSideStep_px = 64;

// Bits from..to-1.
std::uint64_t bits(int from, int to) {
  const std::uint64_t below = to >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << to) - 1;
  return below & (~std::uint64_t{0} << from);
}

}  // namespace

PixelTiles::PixelTiles(vk::Extent2D extent) : extent_(extent) {
  const int longest = static_cast<int>(std::max(extent.width, extent.height));
  const int needed = (longest + kMost - 1) / kMost;
  side_px_ = (needed + kSideStep_px - 1) / kSideStep_px * kSideStep_px;
}

void PixelTiles::add(const PixelBox& box) {
  const PixelBox inside = box.within(PixelBox::whole(extent_));
  if (inside.empty()) return;
  const std::uint64_t row = bits(inside.low.x / side_px_, (inside.high.x + side_px_ - 1) / side_px_);
  for (int y = inside.low.y / side_px_; y * side_px_ < inside.high.y; ++y) rows_[static_cast<std::size_t>(y)] |= row;
}

void PixelTiles::add(const PixelArea& area) {
  everything_ = everything_ || area.everything();
  if (everything_) return;
  for (const PixelBox& box : area.boxes()) add(box);
}

PixelTiles::Part PixelTiles::tightened(const Part& part) const {
  const std::uint64_t columns = bits(part.low.x, part.high.x);
  std::uint64_t any = 0;
  Part tight;
  for (int y = part.low.y; y < part.high.y; ++y) {
    const std::uint64_t row = rows_[static_cast<std::size_t>(y)] & columns;
    if (row == 0) continue;
    if (any == 0) tight.low.y = y;
    tight.high.y = y + 1;
    any |= row;
  }
  if (any == 0) return {};
  tight.low.x = std::countr_zero(any);
  tight.high.x = kMost - std::countl_zero(any);
  return tight;
}

int PixelTiles::pixels(const Part& part) const {
  return (part.high.x - part.low.x) * (part.high.y - part.low.y) * side_px_ * side_px_;
}

PixelTiles::Cut PixelTiles::best_cut(const Part& part) const {
  Cut best;
  for (glm::length_t axis = 0; axis < 2; ++axis) {
    for (int at = part.low[axis] + 1; at < part.high[axis]; ++at) {
      Part first = part, second = part;
      first.high[axis] = second.low[axis] = at;
      first = tightened(first);
      second = tightened(second);
      const int saved = pixels(part) - pixels(first) - pixels(second);
      if (saved > best.saved_px) best = {saved, first, second};
    }
  }
  return best;
}

PixelArea PixelTiles::area() const {
  PixelArea area;
  if (everything_) {
    area.add_everything();
    return area;
  }
  std::array<Part, PixelArea::kMostBoxes> parts;
  std::array<Cut, PixelArea::kMostBoxes> cuts;
  parts[0] = tightened({{0, 0}, {kMost, kMost}});
  if (parts[0].high.x == 0) return area;
  cuts[0] = best_cut(parts[0]);
  std::size_t count = 1;
  while (count < parts.size()) {
    const auto most = std::max_element(cuts.begin(), cuts.begin() + static_cast<std::ptrdiff_t>(count),
                                       [](const Cut& a, const Cut& b) { return a.saved_px < b.saved_px; });
    if (most->saved_px < PixelArea::kPixelsOfBox) break;
    const auto i = static_cast<std::size_t>(most - cuts.begin());
    parts[count] = most->second;
    parts[i] = most->first;
    cuts[i] = best_cut(parts[i]);
    cuts[count] = best_cut(parts[count]);
    ++count;
  }
  std::array<PixelBox, PixelArea::kMostBoxes> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    boxes[i] = PixelBox{side_px_ * parts[i].low, side_px_ * parts[i].high}.within(PixelBox::whole(extent_));
  }
  return PixelArea(std::span(boxes).first(count));
}

}  // namespace afm::render
