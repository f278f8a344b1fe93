// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "device/shader_interface.h"
#include "passes/scene_geometry.h"
#include "render/frame.h"

namespace afm::render {

inline constexpr std::uint32_t kShadowMapSize = AFM_SHADOW_MAP_SIZE;

// Clip space of the shadow map from the room: an orthographic view along the light that covers its sphere, depth 0 at
// the side nearest to the light.
glm::mat4 shadow_from_room(const KeyLight& light);

// The uniforms of one pass whose gl_ViewIndex 0 is `first_eye`: with one pass for each eye the right one passes 1.
// `size` is an eye image's in pixels, `guard_band` as in EyeTargets.
FrameBlock make_frame_block(const FrameState& frame, std::size_t first_eye, const glm::vec2& size, float guard_band);

// Inverse transpose of the upper 3x3, scaled so that its longest column has length 1: the scene's own units span seven
// decades. Identity for a singular matrix, whose mesh has no area.
glm::dmat3 normal_matrix(const glm::dmat4& room_from_node);

// A node's DrawBlock::bend.
glm::vec4 bend_of(const FrameState& frame, scene::NodeIndex node);

// Marks the nodes that glow: the highlighted ones and all their descendants.
void mark_highlighted(const FrameState& frame, const SceneGeometry& geometry, std::vector<std::uint8_t>& glowing);

// One block for each of the geometry's draws, `stride` bytes apart from `blocks` on.
void write_draw_blocks(const FrameState& frame, const SceneGeometry& geometry, const std::vector<std::uint8_t>& glowing,
                       std::byte* blocks, std::size_t stride);

}  // namespace afm::render
