// SPDX-License-Identifier: Apache-2.0
// Makes soft shadows of the shadow map: at each texel the mean depth around it and the mean of its square, first along
// the rows, then along the columns. From these two the share of the light is known at any depth
// (W. Donnelly and A. Lauritzen, "Variance Shadow Maps", 2006), with one filtered look-up.
#version 460
#extension GL_EXT_control_flow_attributes : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

layout(constant_id = AFM_CONSTANT_VARIANT) const uint kVariant = 0;  // 0: rows of the shadow map, 1: columns of the result

layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2D source;

layout(location = 0) out vec2 moments;

const int kReach = AFM_PENUMBRA_REACH;
#if AFM_PENUMBRA_REACH != 3
#error each distance has a variable
#endif

// Of the four texels of the shadow map in one, whose corner is there; or of the result.
vec2 moments_at(vec2 place) {
  if (kVariant != 0u) return textureLod(source, place, 0.0).rg;
  vec4 depths = textureGather(source, place);
  return 0.25 * vec2(dot(depths, vec4(1.0)), dot(depths, depths));
}

void main() {
  const float texel = 1.0 / float(AFM_SOFT_SHADOW_SIZE);
  vec2 place = gl_FragCoord.xy * texel;
  vec2 apart = kVariant == 0u ? vec2(texel, 0.0) : vec2(0.0, texel);
  vec2 middle = moments_at(place);
  float nearest = middle.r, farthest = middle.r;

  // from 0 to both sides; a loop, since a CPU device takes milliseconds to compile each look-up
  vec2 one = vec2(0.0), two = vec2(0.0), three = vec2(0.0);  // sums at these distances, once the loop is done
  [[dont_unroll]] for (int i = 1; i <= kReach; ++i) {
    vec2 before = moments_at(place - float(i) * apart), after = moments_at(place + float(i) * apart);
    nearest = min(nearest, min(before.r, after.r));
    farthest = max(farthest, max(before.r, after.r));
    one = two;
    two = three;
    three = before + after;
  }

  // the edge is as wide as the softbox seen from there
  float radius = clamp(AFM_PENUMBRA * float(AFM_SOFT_SHADOW_SIZE) * (farthest - nearest), 1.0, float(kReach));
  vec3 weights = max(1.0 - vec3(1.0, 2.0, 3.0) / (radius + 1.0), 0.0);
  moments = (middle + weights.x * one + weights.y * two + weights.z * three) / (1.0 + 2.0 * (weights.x + weights.y + weights.z));
}
