// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "device/shader_interface.h"
#include "drawing/draw_box.h"
#include "drawing/draw_list.h"
#include "drawing/eye_targets.h"
#include "drawing/pixel_area.h"
#include "drawing/pixel_tiles.h"
#include "drawing/scene_geometry.h"
#include "panels/panels.h"
#include "render/frame.h"

namespace afm::render {

// Everything that the eyes' pictures depend on, as the shaders read it. The differences between two of these determine
// what must be redrawn, so anything drawn must be included here or constant after loading.
class DrawnFrame {
 public:
  void take(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list, const EyePassConfig& drawing,
            float guard_band, const Panels& panels);

  // Makes this frame differ from every other in everything, because the picture's contents are unknown.
  void forget() { known_ = false; }

  // Blocks of the geometry's draws, one each.
  std::span<const DrawBlock> blocks() const { return blocks_; }

  // SceneGeometry::copy_count() copies, those of a node from Draw::first_copy on. Hidden ones are all 0.
  std::span<const MeshCopy> copies() const { return copies_; }

  // SceneGeometry::shape_count() vertices, those of a draw from Draw::first_vertex on; from earlier frames if
  // this one has none.
  std::span<const scene::Vertex> shapes() const { return shapes_; }

  // Computes bounds(), unless they are known; unchanged draws take them from `before`. Only parts of a picture need
  // them.
  void find_bounds(const SceneGeometry& geometry, const DrawnFrame& before);

  // Pixels of an eye's image in which either eye may see the draw; empty if it is not drawn.
  const PixelBox& bounds(std::uint32_t draw) const { return bounds_[draw]; }

 private:
  friend class Damage;
  // flags in how_
  static constexpr std::uint8_t kDrawn = 1, kCasts = 2, kMirrored = 4, kPerVertex = 8, kLightPerVertex = 16;

  glm::dmat4 room_from_node(std::uint32_t draw) const;  // matrix as used by the shaders
  bool same_for_all(const DrawnFrame& other) const;
  bool same(const DrawnFrame& other, std::uint32_t draw) const;
  bool same_shape(const DrawnFrame& other, const SceneGeometry& geometry, std::uint32_t draw) const;
  bool same_copies(const DrawnFrame& other, const Draw& draw) const;
  std::span<const MeshCopy> copies_of(const Draw& draw) const;
  bool casts_same_shadow(const DrawnFrame& other, std::uint32_t draw) const;
  bool is(std::uint32_t draw, std::uint8_t what) const { return (how_[draw] & what) != 0; }
  PixelBox seen(std::span<const glm::dvec3> hull_m) const;  // bounds of points in the room
  PixelBox seen(const glm::dmat4& room_from_box, const glm::dvec3& low, const glm::dvec3& high) const;
  PixelBox seen(const PanelState& panel, const PanelPart& part) const;

  bool known_ = false;
  EyePassConfig drawing_;
  FrameBlock rest_{};  // uniforms without the mark at the contact
  glm::vec4 contact_{0.0F}, contact_ring_{0.0F};
  bool hazy_ = false;
  std::array<glm::dmat4, 2> clip_from_room_{};
  std::array<double, 2> near_m_{};
  std::vector<DrawBlock> blocks_;  // indexed by draw
  std::vector<std::uint8_t> how_;  // flags such as kDrawn, indexed by draw
  std::vector<MeshCopy> copies_;
  std::vector<std::uint32_t> copy_counts_;  // indexed by node
  std::vector<scene::Vertex> shapes_;
  bool bounds_known_ = false;
  std::vector<PixelBox> bounds_;      // indexed by draw
  std::vector<std::uint32_t> order_;  // drawing order
  std::vector<PanelState> panels_;
  std::vector<std::uint8_t> glowing_;
};

// Part of the eyes' images in which a frame differs from the last one. A changed draw or copy counts at its old and its
// new position, with its shadow on all unchanged draws: the column behind it along the light. If a change affects
// everything (eyes, light, resolution, fog), or many draws change, the part is everything. Never too small; keeps its
// memory.
class Damage {
 public:
  // Finds the bounds of both if the part is not everything.
  PixelArea between(DrawnFrame& before, DrawnFrame& now, const SceneGeometry& geometry);

 private:
  // Box, in its own frame, whose contents may look different.
  struct Volume {
    glm::dmat4 box_from_room{1.0};
    glm::dvec3 low{0.0}, high{0.0};
    glm::dvec3 per_m{1.0};  // largest number of units along each axis per metre of the room
  };
  struct CopyChange {
    std::uint32_t draw = 0;
    std::uint32_t copy = 0;  // index in the draw
  };
  bool find_changed(const DrawnFrame& before, const DrawnFrame& now, const SceneGeometry& geometry);
  bool find_changed_copies(const DrawnFrame& before, const DrawnFrame& now, std::uint32_t draw, const Draw& shown);
  bool same_order(const DrawnFrame& before, const DrawnFrame& now) const;
  static void add_draw(const DrawnFrame& of, std::uint32_t draw, const SceneGeometry& geometry, PixelTiles& tiles);
  void add_copy(const CopyChange& change, const DrawnFrame& before, const DrawnFrame& now,
                const SceneGeometry& geometry, PixelTiles& tiles) const;
  static void add_reached_box(const Volume& volume, const DrawnFrame& now, std::uint32_t draw, const DrawBox& box,
                              const glm::dvec3& edge, PixelTiles& tiles);
  void add_reached(const Volume& volume, const DrawnFrame& now, const SceneGeometry& geometry, PixelTiles& tiles) const;
  void add_shadow(const DrawnFrame& of, std::uint32_t draw, const DrawnFrame& now, const SceneGeometry& geometry,
                  PixelTiles& tiles) const;
  void add_column(const DrawnFrame& of, std::uint32_t draw, const DrawBox& part, const DrawnFrame& now,
                  const SceneGeometry& geometry, PixelTiles& tiles) const;
  void add_contact(const DrawnFrame& of, const DrawnFrame& now, const SceneGeometry& geometry, PixelTiles& tiles) const;
  static void add_panels(const DrawnFrame& before, const DrawnFrame& now, PixelTiles& tiles);

  std::vector<std::uint8_t> changed_;     // flags indexed by draw
  std::vector<std::uint32_t> changes_;    // changed draws
  std::vector<CopyChange> copy_changes_;  // changed copies of draws that are otherwise unchanged
};

// Newest changes of the eyes' images, so that pictures made from an earlier state can follow them.
class EyeChanges {
 public:
  // Call once for every frame that changes something.
  void add(const PixelArea& area);

  // Number of changes so far.
  std::uint64_t count() const { return count_; }

  // Area of a picture of that size that has changed since there were `count` changes; everything if that is long ago.
  PixelArea since(std::uint64_t count, vk::Extent2D extent) const;

 private:
  static constexpr std::size_t kKept = 8;
  std::array<PixelArea, kKept> newest_;  // ring buffer: change i is at i % kKept
  std::uint64_t count_ = 0;
};

}  // namespace afm::render
