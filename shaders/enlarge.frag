// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

// The room, drawn with fewer pixels, over all pixels of an eye's image, with its depth, which hides what is drawn over
// it afterwards. Blends encoded values: decoding would cost more than the difference is worth.
layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2DArray room;
layout(set = 0, binding = AFM_BINDING_ROOM_DEPTH) uniform sampler2DArray room_depth;
layout(push_constant) uniform Enlarge { EnlargeBlock enlarge; };
layout(location = 0) out vec4 out_color;

void main() {
#ifdef AFM_ONE_VIEW
  int layer = enlarge.layer.x;
#else
  int layer = gl_ViewIndex;
#endif
  // keeps undrawn pixels out, even with the weight of a rounded coordinate
  const float kOffUndrawn = 0.5 + 1.0 / 1024.0;
  vec2 place = gl_FragCoord.xy * enlarge.drawn.xy;
  vec2 inside = min(place, enlarge.drawn.zw - kOffUndrawn);
  out_color = textureLod(room, vec3(inside / vec2(textureSize(room, 0).xy), layer), 0.0);
  gl_FragDepth = texelFetch(room_depth, ivec3(inside, layer), 0).r;
}
