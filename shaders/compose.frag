// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

// The eye images hold sRGB values in a UNORM format: bytes go through unchanged.
layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2D left_eye;
layout(set = 0, binding = AFM_BINDING_RIGHT_EYE) uniform sampler2D right_eye;
layout(push_constant) uniform Compose { ComposeBlock compose; };
layout(location = 0) out vec4 out_color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  bool right = compose.mode.x == AFM_LAYOUT_RIGHT;
  if (compose.mode.x == AFM_LAYOUT_SIDE_BY_SIDE && pixel.x >= compose.mode.y) {
    right = true;
    pixel.x -= compose.mode.y;
  }
  out_color = right ? texelFetch(right_eye, pixel, 0) : texelFetch(left_eye, pixel, 0);
}
