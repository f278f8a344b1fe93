// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "beam.glsl"
#include "frame.glsl"
#include "lighting.glsl"
#include "view.glsl"

layout(set = AFM_SET_DRAW, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;

// centroid: a thin or grazing triangle rarely covers the pixel's centre, where its place in room and shadow map would be
// far outside it
layout(location = 0) centroid out vec3 room_position;
layout(location = 1) centroid out vec3 room_normal;
layout(location = 2) out vec4 vertex_color;
layout(location = 3) centroid out vec4 shadow_place;  // w: see shadow_place.glsl
layout(location = 4) flat out vec4 lobe;  // border, spread
layout(location = 5) flat out vec4 drawn_surface;  // as DrawBlock::surface; z: 1 with an outline
layout(location = 6) flat out vec4 drawn_emissive;

#include "placing.glsl"
#include "shadow_place.glsl"

void main() {
  room_position = (draw.room_from_node * vec4(bent_position(position), 1.0)).xyz;
  room_normal = normal_in_room(position, normal);
  vertex_color = color * draw.base_color;
  shadow_place = varying_place(room_position, normalize(room_normal), draw.surface.w);
  Lobe its = lobe_of(draw.surface.y);
  lobe = vec4(its.border, its.spread);
  drawn_surface = vec4(draw.surface.xy, draw.bend.z, draw.surface.w);
  drawn_emissive = draw.emissive;
  gl_Position = view_clip_from_room() * vec4(room_position, 1.0);
  // the ruler is unlit, and stays visible
  if (frame.fog.w * draw.surface.z > 0.0) gl_Position.z = AFM_FRONT_DEPTH * gl_Position.w;
}
