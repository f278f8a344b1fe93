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

// Shades opaque surfaces at their vertices if their triangles are about as small as pixels. A device shades at least a
// few pixels of every triangle, so each pixel would otherwise be shaded several times.
layout(set = AFM_SET_DRAW, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };
layout(set = 0, binding = AFM_BINDING_SHADOW) uniform sampler2D shadow_map;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;

layout(location = 0) out vec3 shown;  // sRGB

vec3 shadow_place;

#include "key_light.glsl"
#include "placing.glsl"
#include "shadow_place.glsl"
#include "shading.glsl"

void main() {
  vec3 room_position = (draw.room_from_node * vec4(bent_position(position), 1.0)).xyz;
  vec3 room_normal = normalize(normal_in_room(position, normal));
  shadow_place = place_in_shadow_map(room_position, room_normal, draw.surface.w);
  Surface s = surface_at(room_position, room_normal, (color * draw.base_color).rgb, draw.surface);
  shown = srgb_from_linear(shaded(room_position, s, draw.emissive, lobe_of(s.roughness), key_light_visibility()));
  gl_Position = view_clip_from_room() * vec4(room_position, 1.0);
}
