// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "frame.glsl"
#include "view.glsl"

layout(push_constant) uniform Panel { PanelBlock panel; };
layout(location = 0) out vec2 texture_place;

// A rectangle as a triangle strip of four vertices; the texture's first row is at the top.
void main() {
  vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
  texture_place = vec2(corner.x, 1.0 - corner.y);
  vec3 place = panel.lower_left.xyz + corner.x * panel.right.xyz + corner.y * panel.up.xyz;
  gl_Position = view_clip_from_room() * vec4(place, 1.0);
  // text stays visible in front of objects larger than the room
  if (frame.fog.w > 0.0) gl_Position.z = AFM_FRONT_DEPTH * gl_Position.w;
  if (panel.lower_left.w >= 0.0 && panel.lower_left.w != view_eye()) {
    gl_Position = vec4(0.0, 0.0, 0.0, 1.0);  // no area
  }
}
