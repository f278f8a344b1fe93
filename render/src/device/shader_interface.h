// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace afm::render {

using glm::ivec4;
using glm::mat4;
using glm::vec4;

#include "interface.glsl.h"

static_assert(sizeof(FrameBlock) == 448 + 16 * (1 + 4 * AFM_MOST_LIGHTS) &&
              offsetof(FrameBlock, shadow_from_room) == 160);
static_assert(sizeof(DrawBlock) == 176 && offsetof(DrawBlock, base_color) == 112);
static_assert(sizeof(PanelBlock) == 48 && sizeof(CanvasBlock) == 16 && sizeof(ComposeBlock) == 112);
static_assert(sizeof(EnlargeBlock) == 32);
static_assert(sizeof(AnaglyphBlock) == 128 * AFM_MOST_ANAGLYPHS);
static_assert(sizeof(BlendBlock) == 64 * AFM_MOST_BLENDED + 16);

}  // namespace afm::render
