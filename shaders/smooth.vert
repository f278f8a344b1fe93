// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "beam.glsl"
#include "contact.glsl"
#include "frame.glsl"
#include "lighting.glsl"
#include "tone.glsl"
#include "view.glsl"

// Computes the light on rough surfaces with small turns from vertex to vertex, such as the floor, at the vertices: it
// varies slowly there. Computed once with the key light and once without. The edges of shadows and the shade at the
// contact are sharp: smooth.frag.
layout(set = AFM_SET_DRAW, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;

// centroid: as in scene.vert
layout(location = 0) centroid out vec3 room_position;
layout(location = 1) centroid out vec4 shadow_place;  // w: see shadow_place.glsl
layout(location = 2) out vec3 radiance_in_shadow;
layout(location = 3) out vec3 radiance_in_light;
layout(location = 4) out vec4 own;  // emitted light, and alpha

#include "placing.glsl"
#include "shadow_place.glsl"
#include "shading.glsl"

void main() {
  room_position = (draw.room_from_node * vec4(bent_position(position), 1.0)).xyz;
  vec3 room_normal = normalize(normal_in_room(position, normal));
  vec4 its_color = color * draw.base_color;
  shadow_place = varying_place(room_position, room_normal, draw.surface.w);
  Surface s = surface_at(room_position, room_normal, its_color.rgb, draw.surface);
  Lobe lobe = lobe_of(s.roughness);
  radiance_in_shadow = radiance(s, lobe, 0.0);
  radiance_in_light = radiance(s, lobe, 1.0);
  own = vec4(own_light(s, draw.emissive), its_color.a);
  gl_Position = view_clip_from_room() * vec4(room_position, 1.0);
}
