// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2D grid_sheet;
layout(location = 0) in vec2 sheet_place;  // texels
layout(location = 0) out vec4 out_color;

// The sheet's texels have straight alpha.
void main() {
  vec4 color = texture(grid_sheet, sheet_place / vec2(textureSize(grid_sheet, 0)));
  out_color = vec4(color.rgb * color.a, color.a);
}
