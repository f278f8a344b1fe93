// SPDX-License-Identifier: Apache-2.0
// Makes soft shadows of the shadow map: at each texel the mean depth around it and the mean of its square, first along
// the rows, then along the columns. From these two the share of the light is known at any depth
// (W. Donnelly and A. Lauritzen, "Variance Shadow Maps", 2006), with one filtered look-up.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

layout(constant_id = 0) const uint kVariant = 0;  // 0: rows of the shadow map, 1: columns of the result

layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2D source;

layout(location = 0) out vec2 moments;

const int kReach = AFM_PENUMBRA_REACH;
const int kTaps = 2 * kReach + 1;

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
  vec2 around[kTaps];
  float nearest = 1.0, farthest = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    vec2 its = moments_at(place + float(i - kReach) * apart);
    around[i] = its;
    nearest = min(nearest, its.r);
    farthest = max(farthest, its.r);
  }

  // the edge is as wide as the softbox seen from there
  float radius = clamp(AFM_PENUMBRA * float(AFM_SOFT_SHADOW_SIZE) * (farthest - nearest), 1.0, float(kReach));
  moments = vec2(0.0);
  float total = 0.0;
  for (int i = 0; i < kTaps; ++i) {
    float weight = max(1.0 - abs(float(i - kReach)) / (radius + 1.0), 0.0);
    moments += weight * around[i];
    total += weight;
  }
  moments /= total;
}
