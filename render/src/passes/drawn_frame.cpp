// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <utility>

#include "drawing/draw_box.h"
#include "drawing/frame_blocks.h"
#include "passes/damage.h"

namespace afm::render {
namespace {

constexpr int kMarginPx = 2;  // margin for devices that compute in float
constexpr double kFarPx = 1e6;
constexpr MeshCopy kNoCopy{.scale = 0.0F, .turn = glm::vec4(0.0F), .tint = glm::vec4(0.0F)};

// True for equal bytes, which draw the same; equal numbers with different bytes (0 and -0) only cost a redraw.
template <class Block>
bool same_bytes(const Block& a, const Block& b) {
  const auto bytes = [](const Block& block) { return std::as_bytes(std::span(&block, 1)).data(); };
  return std::memcmp(bytes(a), bytes(b), sizeof(Block)) == 0;
}

}  // namespace

// Transform as used by the shaders: a zero matrix collapses a hidden draw to a point.
glm::dmat4 DrawnFrame::room_from_node(std::uint32_t draw) const {
  glm::dmat4 m(blocks_[draw].room_from_node);
  for (glm::length_t column = 0; column < 4; ++column) m[column][3] = column == 3 ? 1.0 : 0.0;
  return m;
}

PixelBox DrawnFrame::seen(std::span<const glm::dvec3> hull_m) const {
  const PixelBox whole = PixelBox::whole(drawing_.extent);
  const glm::dvec2 size(whole.high);
  PixelBox box;
  for (std::size_t eye = 0; eye < clip_from_room_.size(); ++eye) {
    glm::dvec2 least(kFarPx), largest(-kFarPx);
    for (const glm::dvec3& place : hull_m) {
      const glm::dvec4 clip = clip_from_room_[eye] * glm::dvec4(place, 1.0);
      if (!(clip.w > near_m_[eye])) return whole;
      const glm::dvec2 pixel = (0.5 * glm::dvec2(clip) / clip.w + 0.5) * size;
      least = glm::min(least, pixel);
      largest = glm::max(largest, pixel);
    }
    const glm::ivec2 from(glm::floor(glm::clamp(least, -kFarPx, kFarPx)));
    const glm::ivec2 to(glm::ceil(glm::clamp(largest, -kFarPx, kFarPx)));
    box = box.with({from - kMarginPx, to + kMarginPx});
  }
  return box.within(whole);
}

PixelBox DrawnFrame::seen(const glm::dmat4& room_from_box, const glm::dvec3& low, const glm::dvec3& high) const {
  std::array<glm::dvec3, 8> corners_m;
  for (std::size_t i = 0; i < corners_m.size(); ++i) {
    const glm::dvec4 corner((i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                            (i & 4U) != 0 ? high.z : low.z, 1.0);
    corners_m[i] = glm::dvec3(room_from_box * corner);
  }
  return seen(corners_m);
}

PixelBox DrawnFrame::seen(const PanelState& panel, const PanelPart& part) const {
  if (!panel.shown) return {};
  const PanelPlacement& place = panel.placement;
  const glm::dmat4 room_from_panel(glm::dvec4(place.right_m, 0.0), glm::dvec4(place.up_m, 0.0), glm::dvec4(0.0),
                                   glm::dvec4(place.lower_left_m, 1.0));
  return seen(room_from_panel, glm::dvec3(part.low, 0.0), glm::dvec3(part.high, 0.0));
}

void DrawnFrame::take(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list,
                      const EyePassConfig& drawing, float guard_band, const Panels& panels) {
  const auto& draws = geometry.draws();
  known_ = true;
  drawing_ = drawing;
  hazy_ = list.hazy;
  rest_ = make_frame_block(frame, 0, {drawing.extent.width, drawing.extent.height}, guard_band);
  contact_ = std::exchange(rest_.contact, glm::vec4(0.0F));
  contact_ring_ = std::exchange(rest_.contact_ring, glm::vec4(0.0F));
  for (std::size_t eye = 0; eye < frame.eyes.size(); ++eye) {
    clip_from_room_[eye] = frame.eyes[eye].projection * frame.eyes[eye].view;
    near_m_[eye] = frame.eyes[eye].projection[3][2];
  }

  mark_highlighted(frame, geometry, glowing_);
  blocks_.resize(draws.size());
  write_draw_blocks(frame, geometry, glowing_, std::as_writable_bytes(std::span(blocks_)).data(), sizeof(DrawBlock));
  order_.assign(list.opaque.begin(), list.opaque.end());
  order_.insert(order_.end(), list.blended.begin(), list.blended.end());
  how_.assign(draws.size(), 0);
  for (const std::uint32_t i : order_) how_[i] |= kDrawn;
  for (const std::uint32_t i : list.shadow) how_[i] |= kCasts;
  for (std::uint32_t i = 0; i < draws.size(); ++i) {
    if (list.mirrored[i] != 0) how_[i] |= kMirrored;
    if (list.shading[i] == Shading::ByVertex) how_[i] |= kPerVertex;
    if (list.shading[i] == Shading::LightByVertex) how_[i] |= kLightPerVertex;
  }

  copies_.assign(geometry.copy_count(), kNoCopy);
  copy_counts_.assign(frame.room_from_node.size(), 0);
  for (const Draw& draw : draws) {
    if (draw.most_copies == 0) continue;
    const std::span<const MeshCopy> copies = render::copies_of(frame, draw.node);
    copy_counts_[draw.node] = static_cast<std::uint32_t>(copies.size());
    std::copy(copies.begin(), copies.end(), copies_.begin() + draw.first_copy);
  }

  shapes_.resize(geometry.shape_count());
  for (const Draw& draw : draws) {
    if (!draw.reshaped) continue;
    const std::span<const scene::Vertex> shape = shape_of(frame, draw.node);
    std::copy(shape.begin(), shape.end(), shapes_.begin() + draw.first_vertex);
  }

  bounds_.resize(draws.size());
  bounds_known_ = false;
  panels.list(panels_);
}

void DrawnFrame::find_bounds(const SceneGeometry& geometry, const DrawnFrame& before) {
  if (bounds_known_) return;
  const auto& draws = geometry.draws();
  bounds_.assign(draws.size(), {});
  const bool same_eyes = before.bounds_known_ && same_for_all(before);
  for (const std::uint32_t i : order_) {
    if (same_eyes && same(before, i) && same_copies(before, draws[i])) {
      bounds_[i] = before.bounds_[i];
      continue;
    }
    const DrawBox box =
        draws[i].most_copies == 0 ? bent_box(draws[i], blocks_[i].bend) : box_around(draws[i], copies_of(draws[i]));
    bounds_[i] = seen(room_from_node(i), box.center - box.half_size, box.center + box.half_size);
    const auto& variant = draws[i].variant;
    if (variant && geometry.variants()[*variant].topology == scene::Topology::Points && !bounds_[i].empty()) {
      constexpr int kHalfPointPx = AFM_LARGEST_POINT / 2;
      bounds_[i] = PixelBox{bounds_[i].low - kHalfPointPx, bounds_[i].high + kHalfPointPx}.within(
          PixelBox::whole(drawing_.extent));
    }
  }
  bounds_known_ = true;
}

bool DrawnFrame::same_for_all(const DrawnFrame& other) const {
  return known_ && other.known_ && drawing_ == other.drawing_ && hazy_ == other.hazy_ &&
         blocks_.size() == other.blocks_.size() && same_bytes(rest_, other.rest_);
}

bool DrawnFrame::same(const DrawnFrame& other, std::uint32_t draw) const {
  return how_[draw] == other.how_[draw] && same_bytes(blocks_[draw], other.blocks_[draw]);
}

bool DrawnFrame::same_shape(const DrawnFrame& other, const SceneGeometry& geometry, std::uint32_t draw) const {
  const Draw& its = geometry.draws()[draw];
  if (!its.reshaped) return true;
  const auto part = [&](const DrawnFrame& of) {
    return std::as_bytes(
        std::span(of.shapes_).subspan(static_cast<std::size_t>(its.first_vertex), geometry.shape_size(its.node)));
  };
  return std::memcmp(part(*this).data(), part(other).data(), part(*this).size()) == 0;
}

bool DrawnFrame::same_copies(const DrawnFrame& other, const Draw& draw) const {
  const std::span<const MeshCopy> ours = copies_of(draw), theirs = other.copies_of(draw);
  return std::equal(ours.begin(), ours.end(), theirs.begin(), theirs.end());
}

std::span<const MeshCopy> DrawnFrame::copies_of(const Draw& draw) const {
  return std::span(copies_).subspan(draw.first_copy, draw.most_copies > 0 ? copy_counts_[draw.node] : 0);
}

bool DrawnFrame::casts_same_shadow(const DrawnFrame& other, std::uint32_t draw) const {
  constexpr std::uint8_t kMatters = kCasts | kMirrored;
  return (how_[draw] & kMatters) == (other.how_[draw] & kMatters) &&
         same_bytes(blocks_[draw].room_from_node, other.blocks_[draw].room_from_node) &&
         same_bytes(blocks_[draw].bend, other.blocks_[draw].bend);
}

}  // namespace afm::render
