// SPDX-License-Identifier: Apache-2.0
#include "passes/shadow_casters.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "drawing/draw_box.h"
#include "drawing/frame_blocks.h"

namespace afm::render {
namespace {

constexpr int kSettled = 120;  // frames
constexpr vk::Rect2D kWholeMap{.extent = {kShadowMapSize, kShadowMapSize}};

// Smallest rectangle around both, of which either may be empty.
vk::Rect2D around_both(const vk::Rect2D& a, const vk::Rect2D& b) {
  const auto empty = [](const vk::Rect2D& part) { return part.extent.width == 0 || part.extent.height == 0; };
  if (empty(a)) return b;
  if (empty(b)) return a;
  const auto right = [](const vk::Rect2D& part) {
    return part.offset.x + static_cast<std::int32_t>(part.extent.width);
  };
  const auto low = [](const vk::Rect2D& part) { return part.offset.y + static_cast<std::int32_t>(part.extent.height); };
  const vk::Offset2D from{std::min(a.offset.x, b.offset.x), std::min(a.offset.y, b.offset.y)};
  return {.offset = from,
          .extent = {static_cast<std::uint32_t>(std::max(right(a), right(b)) - from.x),
                     static_cast<std::uint32_t>(std::max(low(a), low(b)) - from.y)}};
}

}  // namespace

ShadowCasters::ShadowCasters() : covered_(kWholeMap) {}

// True if the copies are placed as in the previous frame; their tint casts no shadow.
bool ShadowCasters::follow_copies(std::size_t caster, std::span<const MeshCopy> copies) {
  std::vector<MeshCopy>& known = copies_[caster];
  const bool same =
      std::equal(copies.begin(), copies.end(), known.begin(), known.end(), [](const MeshCopy& a, const MeshCopy& b) {
        return a.place == b.place && a.scale == b.scale && a.turn == b.turn;
      });
  if (!same) known.assign(copies.begin(), copies.end());
  return same;
}

// True if the set of draws or the light has changed: there is then nothing to compare with.
bool ShadowCasters::follow(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list) {
  const glm::mat4 map_from_room = shadow_from_room(frame.key_light);
  bool others = map_from_room != map_from_room_ || list.shadow.size() != casters_.size();
  map_from_room_ = map_from_room;
  casters_.resize(list.shadow.size());
  copies_.resize(list.shadow.size());
  frames_at_rest_.resize(list.shadow.size());
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    const std::uint32_t draw = list.shadow[i];
    const scene::NodeIndex node = geometry.draws()[draw].node;
    const Caster caster{.draw = draw,
                        .mirrored = list.mirrored[draw],
                        .room_from_node = glm::mat4(frame.room_from_node[node]),
                        .bend = bend_of(frame, node)};
    others = others || caster.draw != casters_[i].draw;
    const bool same_copies = follow_copies(i, copies_of(frame, node));
    frames_at_rest_[i] = caster == casters_[i] && same_copies ? std::min(frames_at_rest_[i] + 1, kSettled) : 0;
    casters_[i] = caster;
  }
  return others;
}

// True if a separate static map saves at least half of the triangles.
bool ShadowCasters::separate(const SceneGeometry& geometry, const DrawList& list) {
  dynamic_before_.swap(dynamic_);
  dynamic_.clear();
  static_.clear();
  std::size_t static_indices = 0, dynamic_indices = 0;
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    const std::uint32_t draw = casters_[i].draw;
    const bool rests = frames_at_rest_[i] == kSettled;
    (rests ? static_ : dynamic_).push_back(draw);
    (rests ? static_indices : dynamic_indices) += std::size_t{list.copies[draw]} * geometry.draws()[draw].index_count;
  }
  return dynamic_indices <= static_indices;
}

// Area that the casters draw, plus a margin: a texel is drawn if its centre is covered.
vk::Rect2D ShadowCasters::drawn_by(std::span<const std::uint32_t> draws, const FrameState& frame,
                                   const SceneGeometry& geometry) const {
  constexpr double kSize = kShadowMapSize;
  glm::dvec2 low(kSize), high(0.0);
  for (const std::uint32_t i : draws) {
    const Draw& draw = geometry.draws()[i];
    const DrawBox box = shown_box(frame, draw);
    const glm::dmat4 rows = glm::transpose(glm::dmat4(map_from_room_) * frame.room_from_node[draw.node]);
    for (glm::length_t axis = 0; axis < 2; ++axis) {
      const auto [least, largest] = range(rows[axis], box);
      low[axis] = std::min(low[axis], 0.5 * (least + 1.0) * kSize);
      high[axis] = std::max(high[axis], 0.5 * (largest + 1.0) * kSize);
    }
  }
  low = glm::clamp(glm::floor(low) - 1.0, 0.0, kSize);
  high = glm::clamp(glm::ceil(high) + 1.0, low, glm::dvec2(kSize));
  const glm::ivec2 offset(low);
  const glm::uvec2 size(high - low);
  return {.offset = {offset.x, offset.y}, .extent = {size.x, size.y}};
}

void ShadowCasters::draw_everything(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list) {
  static_drawn_ = false;
  const vk::Rect2D before = std::exchange(covered_, drawn_by(list.shadow, frame, geometry));
  changed_ = around_both(before, covered_);
}

ShadowStep ShadowCasters::update(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list) {
  if (follow(frame, geometry, list)) {
    std::fill(frames_at_rest_.begin(), frames_at_rest_.end(), kSettled);
    draw_everything(frame, geometry, list);
    return ShadowStep::Everything;
  }
  if (std::find(frames_at_rest_.begin(), frames_at_rest_.end(), 0) == frames_at_rest_.end()) {
    return ShadowStep::Nothing;
  }
  if (!separate(geometry, list)) {
    draw_everything(frame, geometry, list);
    return ShadowStep::Everything;
  }
  const bool same = static_drawn_ && dynamic_ == dynamic_before_;
  dirty_ = same ? drawn_ : kWholeMap;
  drawn_ = drawn_by(dynamic_, frame, geometry);
  changed_ = around_both(same ? dirty_ : covered_, drawn_);
  covered_ = around_both(covered_, drawn_);
  static_drawn_ = true;
  return same ? ShadowStep::Dynamic : ShadowStep::StaticAndDynamic;
}

}  // namespace afm::render
