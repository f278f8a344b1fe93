// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "device/vulkan.h"
#include "drawing/draw_list.h"
#include "drawing/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

// Part of the shadow map that a frame draws: nothing; everything; or the dynamic casters on a copy of the static map,
// whose changed areas are drawn first.
enum class ShadowStep { Nothing, Everything, StaticAndDynamic, Dynamic };

// Static and dynamic shadow casters, and the part of the map that the dynamic ones cover. In most frames only the tip
// moves, and its shadow is a small part of the map.
class ShadowCasters {
 public:
  ShadowCasters();

  // Call for each frame in turn: the returned steps keep the map up to date with the light and all casters.
  ShadowStep update(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list);

  // Draws of the newest step. A static caster has not moved for many frames.
  std::span<const std::uint32_t> static_casters() const { return static_; }
  std::span<const std::uint32_t> dynamic_casters() const { return dynamic_; }

  // Part of the map that the newest step changes; all of it in the first one.
  const vk::Rect2D& changed() const { return changed_; }

  // Part of the map that differs from the static one before the dynamic casters are drawn; all of it in the first step
  // of two.
  const vk::Rect2D& dirty() const { return dirty_; }

 private:
  struct Caster {
    std::uint32_t draw = 0;
    std::uint8_t mirrored = 0;
    glm::mat4 room_from_node{1.0F};
    glm::vec4 bend{0.0F};

    bool operator==(const Caster&) const = default;
  };

  bool follow_copies(std::size_t caster, std::span<const MeshCopy> copies);
  bool follow(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list);
  bool separate(const SceneGeometry& geometry, const DrawList& list);
  vk::Rect2D drawn_by(std::span<const std::uint32_t> draws, const FrameState& frame,
                      const SceneGeometry& geometry) const;
  void draw_everything(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list);

  glm::mat4 map_from_room_{0.0F};
  std::vector<Caster> casters_;
  std::vector<std::vector<MeshCopy>> copies_;  // indexed by caster
  std::vector<int> frames_at_rest_;            // indexed by caster, up to the count that makes it static
  std::vector<std::uint32_t> static_, dynamic_, dynamic_before_;
  bool static_drawn_ = false;  // true: the static map shows static_
  vk::Rect2D dirty_, drawn_, changed_;
  vk::Rect2D covered_;  // part outside which the map is empty
};

}  // namespace afm::render
