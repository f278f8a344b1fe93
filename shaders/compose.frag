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
  vec2 place = (gl_FragCoord.xy - compose.placement.xy) * compose.placement.zw;
  bool right = compose.mode.x == AFM_LAYOUT_RIGHT;
  if (compose.mode.x == AFM_LAYOUT_SIDE_BY_SIDE && place.x >= float(compose.mode.y)) {
    right = true;
    place.x -= float(compose.mode.y);
  }
  if (compose.placement.z == 1.0 && compose.placement.w == 1.0) {
    ivec2 pixel = ivec2(place);
    out_color = right ? texelFetch(right_eye, pixel, 0) : texelFetch(left_eye, pixel, 0);
  } else {
    vec2 uv = place / vec2(compose.mode.yz);
    out_color = right ? textureLod(right_eye, uv, 0.0) : textureLod(left_eye, uv, 0.0);
  }
}
