// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "device/shader_interface.h"
#include "panels/panels.h"
#include "passes/draw_list.h"
#include "passes/eye_targets.h"
#include "passes/pixel_area.h"
#include "passes/pixel_tiles.h"
#include "passes/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

// All that the pictures of the eyes depend on, as the shaders read it: what two of these differ in is what must be
// drawn again. A thing that is neither here nor constant after loading must not reach a picture.
class DrawnFrame {
 public:
  // Takes a frame. `before` is the frame drawn last: what has stayed has its bounds from there.
  void take(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list, const EyePassConfig& drawing,
            float guard_band, const Panels& panels, const DrawnFrame& before);

  // Nothing is known of what is drawn: it differs from every frame in everything.
  void forget() { known_ = false; }

  // One for each of the geometry's draws.
  std::span<const DrawBlock> blocks() const { return blocks_; }

  // Pixels of an eye's image in which the draw may be seen, of either eye; of what is not drawn, none.
  const PixelBox& bounds(std::uint32_t draw) const { return bounds_[draw]; }

 private:
  friend class Damage;
  bool same_for_all(const DrawnFrame& other) const;
  bool same(const DrawnFrame& other, std::uint32_t draw) const;
  bool casts_same_shadow(const DrawnFrame& other, std::uint32_t draw) const;
  bool is(std::uint32_t draw, std::uint8_t what) const { return (how_[draw] & what) != 0; }
  PixelBox seen(std::span<const glm::dvec3> hull_m) const;  // of points in the room
  PixelBox seen(const glm::dmat4& room_from_box, const glm::dvec3& low, const glm::dvec3& high) const;
  PixelBox seen(const PanelState& panel, const PanelPart& part) const;

  bool known_ = false;
  EyePassConfig drawing_;
  FrameBlock rest_{};  // without the mark at the contact
  glm::vec4 contact_{0.0F}, contact_ring_{0.0F};
  bool hazy_ = false;
  std::array<glm::dmat4, 2> clip_from_room_{};
  std::array<double, 2> near_m_{};
  std::vector<DrawBlock> blocks_;     // by draw
  std::vector<std::uint8_t> how_;     // by draw, of kDrawn and its like
  std::vector<PixelBox> bounds_;      // by draw
  std::vector<std::uint32_t> order_;  // of what is drawn
  std::vector<PanelState> panels_;
  std::vector<std::uint8_t> glowing_;
};

// The part of the eyes' images in which a frame differs from the one drawn last. A thing that has changed counts where
// it was and where it is, with its shadow on all that stays: the column behind it along the light. Where something
// changes that touches everything (eyes, light, resolution, fog), or many things do, it is everything. Never too small;
// keeps its memory.
class Damage {
 public:
  PixelArea between(const DrawnFrame& before, const DrawnFrame& now, const SceneGeometry& geometry);

 private:
  // A box in a frame of its own in which what it holds may look different.
  struct Volume {
    glm::dmat4 box_from_room{1.0};
    glm::dvec3 low{0.0}, high{0.0};
    glm::dvec3 per_m{1.0};  // units along its axes that a metre of the room covers at most
  };
  bool find_changed(const DrawnFrame& before, const DrawnFrame& now);
  bool same_order(const DrawnFrame& before, const DrawnFrame& now) const;
  static void add_draw(const DrawnFrame& of, std::uint32_t draw, const SceneGeometry& geometry, PixelTiles& tiles);
  void add_reached(const Volume& volume, const DrawnFrame& now, const SceneGeometry& geometry, PixelTiles& tiles) const;
  void add_shadow(const DrawnFrame& of, std::uint32_t draw, const DrawnFrame& now, const SceneGeometry& geometry,
                  PixelTiles& tiles) const;
  void add_contact(const DrawnFrame& of, const DrawnFrame& now, const SceneGeometry& geometry, PixelTiles& tiles) const;
  static void add_panels(const DrawnFrame& before, const DrawnFrame& now, PixelTiles& tiles);

  std::vector<std::uint8_t> changed_;   // by draw
  std::vector<std::uint32_t> changes_;  // the draws
};

// The newest changes of the eyes' images, so that what was made of an earlier state follows them.
class EyeChanges {
 public:
  // Once for every frame that changes something.
  void add(const PixelArea& area);

  // Number of changes so far.
  std::uint64_t count() const { return count_; }

  // What has changed of a picture of that size since there were `count` of them; everything if that is long ago.
  PixelArea since(std::uint64_t count, vk::Extent2D extent) const;

 private:
  static constexpr std::size_t kKept = 8;
  std::array<PixelArea, kKept> newest_;  // the change i at i % kKept
  std::uint64_t count_ = 0;
};

}  // namespace afm::render
