// SPDX-License-Identifier: Apache-2.0
// What the vertex shaders of the room do alike. Needs the blocks `frame` and `draw`.

vec3 bent_position(vec3 position) { return position + vec3(0.0, 0.0, beam_deflection(draw.bend, position.x)); }

// Normals transform by the inverse transpose of the bend's Jacobian.
vec3 normal_in_room(vec3 position, vec3 normal) {
  vec3 bent = vec3(normal.x - beam_slope(draw.bend, position.x) * normal.z, normal.yz);
  return draw.normal_column[0].xyz * bent.x + draw.normal_column[1].xyz * bent.y + draw.normal_column[2].xyz * bent.z;
}

// The light is far away, so that this is linear across a triangle. A step off the surface by about a texel of the map, more
// where light grazes, keeps it from shadowing itself.
vec3 place_in_shadow_map(vec3 place, vec3 normal) {
  float grazing = 1.0 - max(dot(normal, frame.light_direction.xyz), 0.0);
  vec3 from = place + normal * frame.light_radiance.w * (0.5 + 1.5 * grazing);
  vec3 clip = (frame.shadow_from_room * vec4(from, 1.0)).xyz;
  return vec3(0.5 * clip.xy + 0.5, clip.z);
}
