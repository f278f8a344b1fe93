// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "device/shader_interface.h"
#include "drawing/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

inline constexpr std::uint32_t kShadowMapSize = AFM_SHADOW_MAP_SIZE;

// Transforms the room to the clip space of the shadow map: an orthographic view along the light that covers its sphere,
// with depth 0 on the side nearest to the light.
glm::mat4 shadow_from_room(const KeyLight& light);

// Uniforms of one pass whose gl_ViewIndex 0 is `first_eye`; with one pass per eye, the right eye's pass uses 1. `size`
// is the size of an eye image in pixels, `guard_band` as in EyeTargets.
FrameBlock make_frame_block(const FrameState& frame, std::size_t first_eye, const glm::vec2& size, float guard_band);

// Inverse transpose of the upper 3x3, scaled so that its longest column has length 1, because the scene's own units
// span seven decades. Identity for a singular matrix, whose mesh has no area.
glm::dmat3 normal_matrix(const glm::dmat4& room_from_node);

// DrawBlock::bend of a node.
glm::vec4 bend_of(const FrameState& frame, scene::NodeIndex node);

// Marks the glowing nodes: the highlighted ones and all their descendants.
void mark_highlighted(const FrameState& frame, const SceneGeometry& geometry, std::vector<std::uint8_t>& glowing);

// Writes one block for each of the geometry's draws, `stride` bytes apart, beginning at `blocks`.
void write_draw_blocks(const FrameState& frame, const SceneGeometry& geometry, const std::vector<std::uint8_t>& glowing,
                       std::byte* blocks, std::size_t stride);

}  // namespace afm::render
