// SPDX-License-Identifier: Apache-2.0
// Code shared by the shaders of the room. Needs `shadow_map`, drawn by soft_shadow.frag, and `shadow_place`, texture
// coordinates and depth in it.

#include "one_light.glsl"

const float kLeastVariance = 2e-7;  // rounding of depths in one plane
const float kLightLeak = 0.12;      // share of the light behind two casters at different depths

// Share of the key light that arrives: at most the share of the depths around that are not nearer to the light, by
// Chebyshev's inequality, and just that share at an edge between two depths. Everything outside the map is lit.
float key_light_visibility() {
  if (kOneLight) return 1.0;
  vec2 moments = textureLod(shadow_map, shadow_place.xy, 0.0).rg;
  float behind = max(min(shadow_place.z, 1.0) - moments.r, 0.0);
  float variance = max(moments.g - moments.r * moments.r, kLeastVariance);
  return max(variance / (variance + behind * behind) - kLightLeak, 0.0) * (1.0 / (1.0 - kLightLeak));
}
