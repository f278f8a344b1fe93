// SPDX-License-Identifier: Apache-2.0
// Background behind everything, linear: a mid-dark gradient that depends on directions in the room, so that it
// continues from tile to tile and around a corner. Projectors leak one eye into the other, so nothing here is black or
// bright. `place` is 0..1 across an eye image, y down. Computed from between the eyes, the gradient is the same in
// both: it lies in the wall's plane, without disparity.
#include "frame.glsl"

vec3 background_color(vec2 place) {
  vec3 direction = normalize(frame.screen[0].xyz + place.x * frame.screen[1].xyz + place.y * frame.screen[2].xyz);
  vec3 top = vec3(0.020, 0.026, 0.040);
  vec3 bottom = vec3(0.046, 0.055, 0.073);
  vec3 color = mix(bottom, top, smoothstep(-0.40, 0.40, direction.y));
  vec2 from_light = (direction.xy - vec2(-0.09, -0.04)) * vec2(1.85, 3.1);
  return color + vec3(0.050, 0.058, 0.070) * exp(-dot(from_light, from_light));
}
