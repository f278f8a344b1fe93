// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

layout(push_constant) uniform Canvas { CanvasBlock canvas; };
layout(location = 0) in vec2 position;  // pixels, y down
layout(location = 1) in vec2 atlas_place;
layout(location = 2) in vec4 color;  // sRGB, straight alpha

layout(location = 0) out vec2 texture_place;
layout(location = 1) out vec4 ink;

void main() {
  texture_place = atlas_place;
  ink = color;
  gl_Position = vec4(position * canvas.scale.xy - 1.0, 0.0, 1.0);
}
