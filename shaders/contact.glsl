// SPDX-License-Identifier: Apache-2.0
// Effects where the tip meets the sample, and the share of fog at a position. Nothing branches on a uniform: where that
// would skip much of a vertex shader, lavapipe recompiles the shader for every new block of uniforms, that is in each
// frame, and keeps the result.
#include "frame.glsl"

// Light that tip and sample block from each other near the contact: a Gaussian of the distance from the apex, so that
// the shade under the tip darkens only as the gap closes.
float contact_shade(vec3 place) {
  vec3 away = (place - frame.contact.xyz) * frame.contact.w;
  return 1.0 - 0.72 * exp2(-2.0 * dot(away, away));
}

// Thin shell of light around the apex, visible where it intersects a surface.
vec3 contact_ring(vec3 place) {
  float off = 3.5 * (length(place - frame.contact.xyz) * frame.contact.w - frame.contact_ring.a);
  return frame.contact_ring.rgb * exp2(-off * off);
}

vec3 shaded_by_contact(vec3 place, vec3 radiance) {
  return radiance * contact_shade(place) + contact_ring(place);
}

float fog(vec3 place) {
  float behind = dot(frame.fog_axis, vec4(place, 1.0));
  float far = smoothstep(0.0, 1.0, (behind - frame.fog.x) * frame.fog.y);
  return max(frame.fog.z, far);
}
