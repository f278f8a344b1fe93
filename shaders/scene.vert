// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "beam.glsl"

layout(set = 0, binding = AFM_BINDING_FRAME, std140) uniform Frame { FrameBlock frame; };
layout(set = 0, binding = AFM_BINDING_DRAWS, std430) readonly buffer Draws { DrawBlock draws[]; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;

layout(location = 0) out vec3 room_position;
layout(location = 1) out vec3 room_normal;
layout(location = 2) out vec4 vertex_color;
layout(location = 3) flat out int draw_index;

void main() {
  vec4 bend = draws[gl_InstanceIndex].bend;
  vec3 bent = position + vec3(0.0, 0.0, beam_deflection(bend, position.x));

  // normals transform by the inverse transpose of the bend's Jacobian
  vec3 bent_normal = vec3(normal.x - beam_slope(bend, position.x) * normal.z, normal.yz);

  room_position = (draws[gl_InstanceIndex].room_from_node * vec4(bent, 1.0)).xyz;
  room_normal = draws[gl_InstanceIndex].normal_column[0].xyz * bent_normal.x +
                draws[gl_InstanceIndex].normal_column[1].xyz * bent_normal.y +
                draws[gl_InstanceIndex].normal_column[2].xyz * bent_normal.z;
  vertex_color = color * draws[gl_InstanceIndex].base_color;
  draw_index = gl_InstanceIndex;
  gl_Position = frame.clip_from_room[gl_ViewIndex] * vec4(room_position, 1.0);
}
