// SPDX-License-Identifier: Apache-2.0
// Code shared by the fragment shaders of the room. Needs `shadow_map` and `shadow_place`, texture coordinates and depth
// in it.

// Share of the key light that arrives, from two bilinear comparisons half a texel off the centre along the diagonal,
// which weight seven of the 3x3 texels. Four comparisons would weight all nine, but take a sixth longer for the whole
// frame on a CPU device. Everything outside the map is lit.
float key_light_visibility() {
  const vec3 offset = vec3(vec2(0.5 / float(AFM_SHADOW_MAP_SIZE)), 0.0);
  return 0.5 * (textureLod(shadow_map, shadow_place - offset, 0.0) + textureLod(shadow_map, shadow_place + offset, 0.0));
}
