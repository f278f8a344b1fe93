// SPDX-License-Identifier: Apache-2.0
// Position of a point of the room in the shadow map. Needs the block `frame`. `unshadowed`: 1 if nothing casts a shadow
// there.

// Linear across a triangle, because the light is far away. A step off the surface by about a texel of the map, more at
// grazing light, keeps it from shadowing itself.
vec3 place_in_shadow_map(vec3 place, vec3 normal, float unshadowed) {
  float grazing = 1.0 - max(dot(normal, frame.light_direction.xyz), 0.0);
  vec3 from = place + normal * frame.light_radiance.w * (0.5 + 1.5 * grazing);
  vec3 clip = (frame.shadow_from_room * vec4(from, 1.0)).xyz;
  // nothing is nearer to the light than depth 0
  return vec3(0.5 * clip.xy + 0.5, clip.z * (1.0 - unshadowed));
}

// The same at a vertex, for a centroid varying. `w` is 1, and the interpolated values are right once divided by the
// interpolated w: lavapipe interpolates them for one place and divides by the depth of another, the pixel's centre.
// From a uniform, so that no compiler removes it.
vec4 varying_place(vec3 place, vec3 normal, float unshadowed) {
  return vec4(place_in_shadow_map(place, normal, unshadowed), dot(frame.light_direction.xyz, frame.light_direction.xyz));
}
