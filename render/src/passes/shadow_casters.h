// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "device/vulkan.h"
#include "passes/draw_list.h"
#include "passes/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

// What of the shadow map a frame draws: nothing; everything; or what moves, onto a map of what rests, which is drawn
// first where it is another than before.
enum class ShadowStep { Nothing, Everything, RestingAndMoving, Moving };

// Which casters of shadows rest and which move, and where what moves was drawn. In most frames the tip alone moves: its
// shadow is a small part of the map.
class ShadowCasters {
 public:
  // To be called for each frame in turn: by what it asks for, the map follows the light and everything that casts a
  // shadow.
  ShadowStep take(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list);

  // Draws of the newest step. Those that rest have done so for many frames.
  std::span<const std::uint32_t> resting() const { return resting_; }
  std::span<const std::uint32_t> moving() const { return moving_; }

  // Where the map is not that of what rests, before moving() is drawn onto it: the whole of it in the first step of
  // two.
  const vk::Rect2D& stale() const { return stale_; }

 private:
  struct Caster {
    std::uint32_t draw = 0;
    std::uint8_t mirrored = 0;
    glm::mat4 room_from_node{1.0F};
    glm::vec4 bend{0.0F};

    bool operator==(const Caster&) const = default;
  };

  bool follow(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list);
  bool sort_out(const SceneGeometry& geometry);
  vk::Rect2D drawn_by_moving(const FrameState& frame, const SceneGeometry& geometry) const;

  glm::mat4 map_from_room_{0.0F};
  std::vector<Caster> casters_;
  std::vector<int> frames_at_rest_;  // of each caster, up to those after which it is one that rests
  std::vector<std::uint32_t> resting_, moving_, moved_before_;
  bool resting_drawn_ = false;  // resting_ is what the map of what rests holds
  vk::Rect2D stale_, drawn_;
};

}  // namespace afm::render
