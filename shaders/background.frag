// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "background.glsl"
#include "frame.glsl"
#include "tone.glsl"

layout(location = 0) out vec4 out_color;

void main() {
  vec3 color = background_color(gl_FragCoord.xy * frame.target_size.zw);

  // interleaved gradient noise (J. Jimenez, SIGGRAPH 2014) of one step of an 8-bit image, to hide bands
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  out_color = vec4(srgb_from_linear(color) + noise / 255.0, 1.0);
}
