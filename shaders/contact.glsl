// SPDX-License-Identifier: Apache-2.0
// What happens where the tip meets the sample, and how far a place has dissolved into the fog. Nothing branches by a
// uniform: where that would leave out much of a vertex shader, lavapipe compiles the shader anew with every new block of
// uniforms, that is in each frame, and keeps what it has compiled.

// Light that the tip and the sample take from each other near the contact: a Gaussian of the distance from the apex, so that
// the shade under the tip grows dark only as the gap closes.
float contact_shade(FrameBlock frame, vec3 place) {
  vec3 away = (place - frame.contact.xyz) * frame.contact.w;
  return 1.0 - 0.72 * exp2(-2.0 * dot(away, away));
}

// A thin shell of light around the apex, seen where it cuts a surface.
vec3 contact_ring(FrameBlock frame, vec3 place) {
  float off = 3.5 * (length(place - frame.contact.xyz) * frame.contact.w - frame.contact_ring.a);
  return frame.contact_ring.rgb * exp2(-off * off);
}

vec3 shaded_by_contact(FrameBlock frame, vec3 place, vec3 radiance) {
  return radiance * contact_shade(frame, place) + contact_ring(frame, place);
}

float fog(FrameBlock frame, vec3 place) {
  float behind = dot(frame.fog_axis, vec4(place, 1.0));
  float far = smoothstep(0.0, 1.0, (behind - frame.fog.x) * frame.fog.y);
  return max(frame.fog.z, far);
}
