// SPDX-License-Identifier: Apache-2.0
// Code shared by the vertex shaders of the room. Needs the blocks `frame` and `draw`.

vec3 bent_position(vec3 position) { return position + vec3(0.0, 0.0, beam_deflection(draw.bend, position.x)); }

// Normals transform by the inverse transpose of the bend's Jacobian.
vec3 normal_in_room(vec3 position, vec3 normal) {
  vec3 bent = vec3(normal.x - beam_slope(draw.bend, position.x) * normal.z, normal.yz);
  return draw.normal_column[0].xyz * bent.x + draw.normal_column[1].xyz * bent.y + draw.normal_column[2].xyz * bent.z;
}
