// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "beam.glsl"
#include "view.glsl"

layout(set = 0, binding = AFM_BINDING_FRAME, std140) uniform Frame { FrameBlock frame; };
layout(set = 0, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;

layout(location = 0) out vec3 room_position;
layout(location = 1) centroid out vec3 room_normal;  // a thin triangle seldom covers the pixel's middle
layout(location = 2) out vec4 vertex_color;
layout(location = 3) out vec3 shadow_place;

// The light is far away, so that this is linear across a triangle. A step off the surface by about a texel of the map, more
// where light grazes, keeps it from shadowing itself.
vec3 place_in_shadow_map(vec3 place, vec3 normal) {
  float grazing = 1.0 - max(dot(normal, frame.light_direction.xyz), 0.0);
  vec3 from = place + normal * frame.light_radiance.w * (0.5 + 1.5 * grazing);
  vec3 clip = (frame.shadow_from_room * vec4(from, 1.0)).xyz;
  return vec3(0.5 * clip.xy + 0.5, clip.z);
}

void main() {
  vec4 bend = draw.bend;
  vec3 bent = position + vec3(0.0, 0.0, beam_deflection(bend, position.x));

  // normals transform by the inverse transpose of the bend's Jacobian
  vec3 bent_normal = vec3(normal.x - beam_slope(bend, position.x) * normal.z, normal.yz);

  room_position = (draw.room_from_node * vec4(bent, 1.0)).xyz;
  room_normal = draw.normal_column[0].xyz * bent_normal.x +
                draw.normal_column[1].xyz * bent_normal.y +
                draw.normal_column[2].xyz * bent_normal.z;
  vertex_color = color * draw.base_color;
  shadow_place = place_in_shadow_map(room_position, normalize(room_normal));
  gl_Position = view_clip_from_room(frame) * vec4(room_position, 1.0);
  // the ruler is not lit, and stays in sight
  if (frame.haze.w * draw.surface.z > 0.0) gl_Position.z = AFM_FRONT_DEPTH * gl_Position.w;
}
