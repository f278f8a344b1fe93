// SPDX-License-Identifier: Apache-2.0
#include "shadow_casters.h"

#include "frame_blocks.h"

namespace afm::render {

bool ShadowCasters::take(const FrameState& frame, const SceneGeometry& geometry, const DrawList& list) {
  const glm::mat4 map_from_room = shadow_from_room(frame.key_light);
  bool changed = !taken_ || map_from_room != map_from_room_ || list.shadow.size() != casters_.size();
  taken_ = true;
  map_from_room_ = map_from_room;
  casters_.resize(list.shadow.size());
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    const std::uint32_t draw = list.shadow[i];
    const scene::NodeIndex node = geometry.draws()[draw].node;
    const Caster caster{.draw = draw,
                        .mirrored = list.mirrored[draw],
                        .room_from_node = glm::mat4(frame.room_from_node[node]),
                        .bend = bend_of(frame, node)};
    changed = changed || !(caster == casters_[i]);
    casters_[i] = caster;
  }
  return changed;
}

}  // namespace afm::render
