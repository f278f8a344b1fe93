// SPDX-License-Identifier: Apache-2.0
// What the fragment shaders of the room do alike. Needs `shadow_map` and `shadow_place`, texture coordinates and depth in it.

// Share of the key light that arrives: two bilinear comparisons half a texel off the middle along the diagonal, which weigh
// seven of the 3x3 texels. Four would weigh all nine, but a CPU device takes a sixth longer for the whole frame. Outside
// the map everything is lit.
float key_light_visibility() {
  const vec3 offset = vec3(vec2(0.5 / float(AFM_SHADOW_MAP_SIZE)), 0.0);
  return 0.5 * (textureLod(shadow_map, shadow_place - offset, 0.0) + textureLod(shadow_map, shadow_place + offset, 0.0));
}
