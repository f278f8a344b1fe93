// SPDX-License-Identifier: Apache-2.0
// As scene.vert, for the copies of a mesh.
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "frame.glsl"
#include "lighting.glsl"
#include "view.glsl"

layout(set = AFM_SET_DRAW, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 5) in vec4 copy_tint;

layout(location = 0) centroid out vec3 room_position;
layout(location = 1) centroid out vec3 room_normal;
layout(location = 2) out vec4 vertex_color;
layout(location = 3) centroid out vec4 shadow_place;  // w: see shadow_place.glsl
layout(location = 4) flat out vec4 lobe;  // border, spread
layout(location = 5) flat out vec4 drawn_surface;  // as DrawBlock::surface; z: 1 with an outline
layout(location = 6) flat out vec4 drawn_emissive;

#include "copy.glsl"
#include "shadow_place.glsl"

void main() {
  room_position = (draw.room_from_node * vec4(copy_position(position), 1.0)).xyz;
  vec3 in_node = turned(normal);
  room_normal = draw.normal_column[0].xyz * in_node.x + draw.normal_column[1].xyz * in_node.y +
                draw.normal_column[2].xyz * in_node.z;
  vertex_color = color * draw.base_color * vec4(copy_tint.rgb, 1.0);
  shadow_place = varying_place(room_position, normalize(room_normal), draw.surface.w);
  Lobe its = lobe_of(draw.surface.y);
  lobe = vec4(its.border, its.spread);
  drawn_surface = vec4(draw.surface.xy, draw.bend.z, draw.surface.w);
  drawn_emissive = draw.emissive;
  gl_Position = view_clip_from_room() * vec4(room_position, 1.0);
}
