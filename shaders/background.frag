// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "tone.glsl"

layout(set = 0, binding = AFM_BINDING_FRAME, std140) uniform Frame { FrameBlock frame; };
layout(location = 0) out vec4 out_color;

// A mid-dark gradient that is the same in both eyes, so that it lies in the wall's plane and no eye disagrees with the
// other. Projectors leak one eye into the other: nothing here is black or bright.
void main() {
  vec2 place = gl_FragCoord.xy * frame.target_size.zw;
  vec3 top = vec3(0.020, 0.026, 0.040);
  vec3 bottom = vec3(0.046, 0.055, 0.073);
  vec3 color = mix(top, bottom, smoothstep(0.0, 1.0, place.y));
  vec2 from_light = (place - vec2(0.42, 0.55)) * vec2(1.0, 1.25);
  color += vec3(0.050, 0.058, 0.070) * exp(-5.0 * dot(from_light, from_light));

  // interleaved gradient noise (J. Jimenez, SIGGRAPH 2014) of one step of an 8-bit image hides the bands
  float noise = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
  out_color = vec4(srgb_from_linear(color) + noise / 255.0, 1.0);
}
