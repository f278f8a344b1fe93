// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

// The eye images hold sRGB values in a UNORM format: bytes go through unchanged.
layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2D left_eye;
layout(set = 0, binding = AFM_BINDING_RIGHT_EYE) uniform sampler2D right_eye;
layout(push_constant) uniform Compose { ComposeBlock compose; };
layout(location = 0) out vec4 out_color;

// The eye's colour at a place in pixels of a whole eye image: the pixel itself where nothing is scaled, else bilinear
// within what is drawn.
vec4 eye_color(bool right, vec2 place) {
  right = right && compose.mode.w == 0;
  if (compose.placement.zw == vec2(1.0) && compose.drawn.xy == vec2(1.0)) {
    return right ? texelFetch(right_eye, ivec2(place), 0) : texelFetch(left_eye, ivec2(place), 0);
  }
  vec2 texels = vec2(compose.mode.yz);
  vec2 uv = min(place / texels * compose.drawn.xy, compose.drawn.xy - 0.5 / texels);
  return right ? textureLod(right_eye, uv, 0.0) : textureLod(left_eye, uv, 0.0);
}

void main() {
  vec2 place = (gl_FragCoord.xy - compose.placement.xy) * compose.placement.zw;
  bool right = compose.mode.x == AFM_LAYOUT_RIGHT;
  if (compose.mode.x == AFM_LAYOUT_SIDE_BY_SIDE && place.x >= float(compose.mode.y)) {
    right = true;
    place.x -= float(compose.mode.y);
  }
  out_color = eye_color(right, place);
}
