// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

// Smallest and largest depth of both eyes' images. Depths are positive floats, which sort like their bits.
layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2D left_depth;
layout(set = 0, binding = AFM_BINDING_RIGHT_EYE) uniform sampler2D right_depth;
layout(set = 0, binding = AFM_BINDING_DEPTH_RANGE, std430) buffer Range { uint range[2]; };
layout(push_constant) uniform Drawn { ivec4 drawn; };  // xy: drawn pixels of each image

const int kTile = 8;  // pixels in each direction per invocation

shared uint least;
shared uint greatest;

void look(float depth, inout uint low, inout uint high) {
  if (depth > 0.0) {  // 0: nothing drawn
    low = min(low, floatBitsToUint(depth));
    high = max(high, floatBitsToUint(depth));
  }
}

void main() {
  if (gl_LocalInvocationIndex == 0) {
    least = 0xFFFFFFFFu;
    greatest = 0u;
  }
  barrier();
  uint low = 0xFFFFFFFFu;
  uint high = 0u;
  ivec2 first = ivec2(gl_GlobalInvocationID.xy) * kTile;
  ivec2 end = min(first + kTile, drawn.xy);
  for (int y = first.y; y < end.y; ++y) {
    for (int x = first.x; x < end.x; ++x) {
      look(texelFetch(left_depth, ivec2(x, y), 0).r, low, high);
      look(texelFetch(right_depth, ivec2(x, y), 0).r, low, high);
    }
  }
  atomicMin(least, low);
  atomicMax(greatest, high);
  barrier();
  if (gl_LocalInvocationIndex == 0) {
    atomicMin(range[0], least);
    atomicMax(range[1], greatest);
  }
}
