// SPDX-License-Identifier: Apache-2.0
// What lies behind everything, linear; `place` is 0..1 across an eye image, y down. A mid-dark gradient that is the same in
// both eyes, so that it lies in the wall's plane and no eye disagrees with the other. Projectors leak one eye into the
// other: nothing here is black or bright.
vec3 background_color(vec2 place) {
  vec3 top = vec3(0.020, 0.026, 0.040);
  vec3 bottom = vec3(0.046, 0.055, 0.073);
  vec3 color = mix(top, bottom, smoothstep(0.0, 1.0, place.y));
  vec2 from_light = (place - vec2(0.42, 0.55)) * vec2(1.0, 1.25);
  return color + vec3(0.050, 0.058, 0.070) * exp(-5.0 * dot(from_light, from_light));
}
