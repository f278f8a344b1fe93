// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "beam.glsl"
#include "frame.glsl"
#include "view.glsl"

layout(set = AFM_SET_DRAW, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
layout(location = 3) in vec4 tangent;      // w: the bitangent's sign
layout(location = 4) in vec4 coordinates;  // both sets

layout(location = 0) out vec3 room_position;
layout(location = 1) centroid out vec3 room_normal;
layout(location = 2) out vec4 vertex_color;
layout(location = 3) centroid out vec4 shadow_place;  // w: see shadow_place.glsl
layout(location = 4) out vec4 room_tangent;
layout(location = 5) out vec4 texture_coordinates;
layout(location = 6) flat out vec4 drawn_surface;
layout(location = 7) flat out vec4 drawn_emissive;

#include "placing.glsl"
#include "shadow_place.glsl"

void main() {
  room_position = (draw.room_from_node * vec4(bent_position(position), 1.0)).xyz;
  room_normal = normal_in_room(position, normal);
  // a mirrored node reverses the cross product of normal and tangent, but not the bitangent
  mat3 linear = mat3(draw.room_from_node);
  room_tangent = vec4(linear * tangent.xyz, determinant(linear) < 0.0 ? -tangent.w : tangent.w);
  vertex_color = color * draw.base_color;
  texture_coordinates = coordinates;
  drawn_surface = draw.surface;
  drawn_emissive = draw.emissive;
  shadow_place = varying_place(room_position, normalize(room_normal), draw.surface.w);
  mat4 clip = view_clip_from_room();
  gl_Position = clip * vec4(room_position, 1.0);
  float pixels_per_metre = 0.5 * frame.punctual_count.z * frame.target_size.y * length(vec3(clip[0].y, clip[1].y, clip[2].y)) / gl_Position.w;
  float largest = frame.punctual_count.y;
  gl_PointSize = clamp(AFM_POINT_SIZE * pixels_per_metre, min(float(AFM_SMALLEST_POINT), largest), largest);
}
