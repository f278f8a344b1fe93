// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "draw_list.h"
#include "render/frame.h"
#include "scene_geometry.h"

namespace afm::render {

// All that the shadow map depends on, as of the newest frame: the map stays as it is while nothing of it changes.
class ShadowCasters {
 public:
  // Whether the light or anything that casts a shadow is another than at the call before; the first time, too.
  bool take(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list);

 private:
  struct Caster {
    std::uint32_t draw = 0;
    std::uint8_t mirrored = 0;
    glm::mat4 room_from_node{1.0F};
    glm::vec4 bend{0.0F};

    bool operator==(const Caster&) const = default;
  };

  bool taken_ = false;
  glm::mat4 map_from_room_{1.0F};
  std::vector<Caster> casters_;
};

}  // namespace afm::render
