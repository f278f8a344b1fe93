// SPDX-License-Identifier: Apache-2.0
#include "passes/damage.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <span>

#include "drawing/draw_box.h"
#include "drawing/frame_blocks.h"

namespace afm::render {
namespace {

constexpr std::size_t kMostChanged = 64;  // number of draws beyond which redrawing everything costs about as much
constexpr double kMostOfPicture = 0.75;   // same limit as a share: each rectangle processes the vertices again
constexpr double kFarDepth =
    1e3;                   // in depth ranges of the shadow map; edges that leave a slab farther away are parallel to it
constexpr int kParts = 8;  // parts with bounds of their own: a long object at an angle fills little of its box

// Reach of a surface's shadow lookup, in texels of the shadow map: a step of up to two off the surface, interpolation
// between four texels of the soft shadow, what these reach around them, and the device's precision.
constexpr double kShadowTexels = 4.0 + (AFM_PENUMBRA_REACH + 1.5) * AFM_SHADOW_MAP_SIZE / AFM_SOFT_SHADOW_SIZE;

// Beyond these radii the mark at the contact is invisible: the shade 1 - 0.72 * exp2(-2 r * r) is 1 in 32 bits
// (shaders/contact.glsl), and a ring's light, exp2(-(3.5 * 2)^2), is lost in that of any surface.
constexpr double kShadeReach = 3.6, kRingReach = 2.0;

// Longest edge of a draw's triangles in the room, with the beam's bend.
double longest_edge_m(const Draw& draw, const DrawBlock& block) {
  const glm::dmat4 m(block.room_from_node);
  const double scale = std::max({glm::length(m[0]), glm::length(m[1]), glm::length(m[2])});
  const double slope = 1.5 * std::abs(static_cast<double>(block.bend.x) * static_cast<double>(block.bend.y));
  return static_cast<double>(draw.longest_edge) * scale * (1.0 + slope);
}

// Calls `take` with the bent parts of a draw: slices across its longest axis.
template <class Take>
void for_each_part(const Draw& draw, const DrawBlock& block, const Take& take) {
  const glm::dmat4 m(block.room_from_node);
  DrawBox part = box_of(draw);
  const auto length = [&](glm::length_t axis) { return part.half_size[axis] * glm::length(glm::dvec3(m[axis])); };
  glm::length_t along = 0;
  for (const glm::length_t axis : {1, 2}) {
    if (length(axis) > length(along)) along = axis;
  }
  part.half_size[along] /= kParts;
  part.center[along] -= (kParts - 1) * part.half_size[along];
  for (int i = 0; i < kParts; ++i) {
    take(bent_box(part, block.bend));
    part.center[along] += 2.0 * part.half_size[along];
  }
}

}  // namespace

// ---- differences ----

// Finds the changed draws. Returns false if there are too many.
bool Damage::find_changed(const DrawnFrame& before, const DrawnFrame& now, const SceneGeometry& geometry) {
  changed_.assign(now.blocks_.size(), 0);
  changes_.clear();
  copy_changes_.clear();
  for (std::uint32_t i = 0; i < now.blocks_.size(); ++i) {
    const bool counts = ((before.how_[i] | now.how_[i]) & (DrawnFrame::kDrawn | DrawnFrame::kCasts)) != 0;
    if (!counts) continue;
    if (const Draw& draw = geometry.draws()[i]; draw.most_copies > 0) {
      if (!find_changed_copies(before, now, i, draw)) return false;
    } else if (!now.same(before, i) || !now.same_shape(before, geometry, i)) {
      changed_[i] = 1;
      changes_.push_back(i);
    }
    if (changes_.size() + copy_changes_.size() > kMostChanged) return false;
  }
  return true;
}

// Returns false if all copies have changed, or too many: their node moves, or their number changes.
bool Damage::find_changed_copies(const DrawnFrame& before, const DrawnFrame& now, std::uint32_t draw,
                                 const Draw& shown) {
  const std::span<const MeshCopy> were = before.copies_of(shown), are = now.copies_of(shown);
  if (!now.same(before, draw) || were.size() != are.size()) return false;
  for (std::uint32_t copy = 0; copy < are.size(); ++copy) {
    if (were[copy] == are[copy]) continue;
    copy_changes_.push_back({draw, copy});
    if (copy_changes_.size() > kMostChanged) return false;
  }
  return true;
}

// True if the unchanged draws keep their order.
bool Damage::same_order(const DrawnFrame& before, const DrawnFrame& now) const {
  const auto unchanged = [this](std::uint32_t draw) { return changed_[draw] == 0; };
  auto was = before.order_.begin();
  for (const std::uint32_t draw : now.order_) {
    if (!unchanged(draw)) continue;
    was = std::find_if(was, before.order_.end(), unchanged);
    if (was == before.order_.end() || *was != draw) return false;
    ++was;
  }
  return std::find_if(was, before.order_.end(), unchanged) == before.order_.end();
}

void Damage::add_draw(const DrawnFrame& of, std::uint32_t draw, const SceneGeometry& geometry, PixelTiles& tiles) {
  if (of.bounds_[draw].empty()) return;
  const DrawBlock& block = of.blocks_[draw];
  const glm::dmat4 room_from_node = of.room_from_node(draw);
  for_each_part(geometry.draws()[draw], block, [&](const DrawBox& part) {
    tiles.add(
        of.seen(room_from_node, part.center - part.half_size, part.center + part.half_size).within(of.bounds_[draw]));
  });
}

// Adds a changed copy at its old and its new place, with its shadow.
void Damage::add_copy(const CopyChange& change, const DrawnFrame& before, const DrawnFrame& now,
                      const SceneGeometry& geometry, PixelTiles& tiles) const {
  const Draw& draw = geometry.draws()[change.draw];
  const MeshCopy &was = before.copies_of(draw)[change.copy], &is = now.copies_of(draw)[change.copy];
  const bool same_shadow = was.place == is.place && was.scale == is.scale && was.turn == is.turn;
  for (const DrawnFrame* of : {&before, &now}) {
    const DrawBox box = box_of(draw, of->copies_of(draw)[change.copy]);
    tiles.add(of->seen(of->room_from_node(change.draw), box.center - box.half_size, box.center + box.half_size)
                  .within(of->bounds_[change.draw]));
    if (!same_shadow && of->is(change.draw, DrawnFrame::kCasts)) {
      add_column(*of, change.draw, box, now, geometry, tiles);
    }
  }
}

// Adds the area of unchanged draws within the volume. Draws shaded per vertex spread a change along their triangles.
void Damage::add_reached(const Volume& volume, const DrawnFrame& now, const SceneGeometry& geometry,
                         PixelTiles& tiles) const {
  for (const std::uint32_t i : now.order_) {
    if (changed_[i] != 0) continue;
    const DrawBlock& block = now.blocks_[i];
    const Draw& draw = geometry.draws()[i];
    const glm::dvec3 edge =
        now.is(i, DrawnFrame::kPerVertex) ? longest_edge_m(draw, block) * volume.per_m : glm::dvec3(0.0);
    if (draw.most_copies == 0) add_reached_box(volume, now, i, bent_box(draw, block.bend), edge, tiles);
    for (const MeshCopy& copy : now.copies_of(draw)) add_reached_box(volume, now, i, box_of(draw, copy), edge, tiles);
  }
}

// Adds the area of `box`, the extent of a draw or of a part of it.
void Damage::add_reached_box(const Volume& volume, const DrawnFrame& now, std::uint32_t draw, const DrawBox& box,
                             const glm::dvec3& edge, PixelTiles& tiles) {
  const glm::dmat4 box_from_node = volume.box_from_room * now.room_from_node(draw);
  const glm::dmat4 rows = glm::transpose(box_from_node);
  glm::dvec3 low, high;
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const auto [least, largest] = range(rows[axis], box);
    low[axis] = std::max(least, volume.low[axis] - edge[axis]);
    high[axis] = std::min(largest, volume.high[axis] + edge[axis]);
  }
  if (low.x > high.x || low.y > high.y || low.z > high.z) return;
  const glm::dmat4 room_from_box = glm::inverse(volume.box_from_room);
  PixelBox seen = now.seen(room_from_box, low, high).within(now.bounds_[draw]);

  // the points where the column's four edges enter and leave the slab between two sides of the box bound flat objects
  // tightly
  const glm::dmat4 node_from_box = glm::inverse(box_from_node);
  for (glm::length_t axis = 0; axis < 3 && !seen.empty(); ++axis) {
    std::array<glm::dvec3, 8> ends_m;
    bool crosses = true;
    for (std::size_t edge_of = 0; edge_of < 4; ++edge_of) {
      const glm::dvec2 at((edge_of & 1U) != 0 ? high.x : low.x, (edge_of & 2U) != 0 ? high.y : low.y);
      const double from = (node_from_box * glm::dvec4(at, 0.0, 1.0))[axis], slope = node_from_box[2][axis];
      for (const std::size_t side : {0U, 1U}) {
        const double plane = box.center[axis] + (side == 0 ? -1.0 : 1.0) * box.half_size[axis];
        const double depth = (plane - from) / slope;
        crosses = crosses && std::abs(depth) < kFarDepth;
        ends_m[2 * edge_of + side] = glm::dvec3(room_from_box * glm::dvec4(at, crosses ? depth : 0.0, 1.0));
      }
    }
    if (crosses) seen = seen.within(now.seen(ends_m));
  }
  tiles.add(seen);
}

// Adds the areas in the draw's shadow.
void Damage::add_shadow(const DrawnFrame& of, std::uint32_t draw, const DrawnFrame& now, const SceneGeometry& geometry,
                        PixelTiles& tiles) const {
  if (!of.is(draw, DrawnFrame::kCasts)) return;
  for_each_part(geometry.draws()[draw], of.blocks_[draw],
                [&](const DrawBox& part) { add_column(of, draw, part, now, geometry, tiles); });
}

// The column that a part of a draw covers along the light, in the shadow map's clip space. It begins at the light: a
// soft edge depends on all depths around it.
void Damage::add_column(const DrawnFrame& of, std::uint32_t draw, const DrawBox& part, const DrawnFrame& now,
                        const SceneGeometry& geometry, PixelTiles& tiles) const {
  const glm::dmat4 map_from_room(of.rest_.shadow_from_room);
  const glm::dmat4 directions = glm::transpose(map_from_room);
  const glm::dmat4 rows = glm::transpose(map_from_room * of.room_from_node(draw));
  constexpr double kReach = 2.0 * kShadowTexels / kShadowMapSize;
  Volume column{.box_from_room = map_from_room};
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const auto [least, largest] = range(rows[axis], part);
    column.low[axis] = axis == 2 ? std::numeric_limits<double>::lowest() : least - kReach;
    column.high[axis] = axis == 2 ? std::numeric_limits<double>::max() : largest + kReach;
    column.per_m[axis] = glm::length(glm::dvec3(directions[axis]));
  }
  add_reached(column, now, geometry, tiles);
}

void Damage::add_contact(const DrawnFrame& of, const DrawnFrame& now, const SceneGeometry& geometry,
                         PixelTiles& tiles) const {
  if (!(of.contact_.w > 0.0F)) return;
  double reach = kShadeReach;
  if (glm::vec3(of.contact_ring_) != glm::vec3(0.0F)) {
    reach = std::max(reach, static_cast<double>(of.contact_ring_.w) + kRingReach);
  }
  const glm::dvec3 place(of.contact_);
  const glm::dvec3 half(reach / static_cast<double>(of.contact_.w));
  add_reached({.low = place - half, .high = place + half}, now, geometry, tiles);
}

void Damage::add_panels(const DrawnFrame& before, const DrawnFrame& now, PixelTiles& tiles) {
  const std::size_t count = std::max(before.panels_.size(), now.panels_.size());
  for (std::size_t i = 0; i < count; ++i) {
    const PanelState was = i < before.panels_.size() ? before.panels_[i] : PanelState{};
    const PanelState is = i < now.panels_.size() ? now.panels_[i] : PanelState{};
    if (was == is) continue;
    PanelState painted = was;
    painted.painting = is.painting;
    painted.part = is.part;
    const bool only_painted = painted == is && is.painting == was.painting + 1;
    tiles.add(before.seen(was, only_painted ? is.part : PanelPart{}));
    tiles.add(now.seen(is, only_painted ? is.part : PanelPart{}));
  }
}

PixelArea Damage::between(DrawnFrame& before, DrawnFrame& now, const SceneGeometry& geometry) {
  PixelArea area;
  if (!now.same_for_all(before) || !find_changed(before, now, geometry) || !same_order(before, now)) {
    area.add_everything();
    return area;
  }
  before.find_bounds(geometry, before);
  now.find_bounds(geometry, before);
  PixelTiles tiles(now.drawing_.extent);
  for (const std::uint32_t draw : changes_) {
    add_draw(before, draw, geometry, tiles);
    add_draw(now, draw, geometry, tiles);
    if (now.casts_same_shadow(before, draw)) continue;
    add_shadow(before, draw, now, geometry, tiles);
    add_shadow(now, draw, now, geometry, tiles);
  }
  for (const CopyChange& change : copy_changes_) add_copy(change, before, now, geometry, tiles);
  if (before.contact_ != now.contact_ || before.contact_ring_ != now.contact_ring_) {
    add_contact(before, now, geometry, tiles);
    add_contact(now, now, geometry, tiles);
  }
  add_panels(before, now, tiles);
  area = tiles.area();
  if (area.share_of(now.drawing_.extent) > kMostOfPicture) area.add_everything();
  return area;
}

// ---- draws that follow the eyes ----

void EyeChanges::add(const PixelArea& area) { newest_[count_++ % kKept] = area; }

PixelArea EyeChanges::since(std::uint64_t count, vk::Extent2D extent) const {
  PixelArea area;
  if (count_ - count > kKept) {
    area.add_everything();
    return area;
  }
  PixelTiles tiles(extent);
  for (std::uint64_t i = count; i < count_; ++i) tiles.add(newest_[i % kKept]);
  return tiles.area();
}

}  // namespace afm::render
