// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "background.glsl"
#include "contact.glsl"
#include "lighting.glsl"
#include "tone.glsl"
#include "view.glsl"

layout(set = 0, binding = AFM_BINDING_FRAME, std140) uniform Frame { FrameBlock frame; };
layout(set = 0, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };
layout(set = 0, binding = AFM_BINDING_SHADOW) uniform sampler2DShadow shadow_map;

layout(location = 0) in vec3 room_position;
layout(location = 1) centroid in vec3 room_normal;
layout(location = 2) in vec4 vertex_color;
layout(location = 3) in vec3 shadow_place;  // texture coordinates and depth in the shadow map

layout(location = 0) out vec4 out_color;

#include "key_light.glsl"

void main() {
  vec4 parameters = draw.surface;
  vec4 emissive = draw.emissive;
  vec3 to_eye = normalize(view_eye_position(frame) - room_position);
  vec3 normal = normalize(room_normal);
  normal = gl_FrontFacing ? normal : -normal;

  float metallic = parameters.x;
  Surface s = Surface(normal, to_eye, vertex_color.rgb * (1.0 - metallic), mix(vec3(0.04), vertex_color.rgb, metallic),
                      parameters.y);
  Key key = Key(frame.light_direction.xyz, key_light_visibility());
  vec3 radiance = studio_reflection(s, key) + key_reflection(s, key.axis) * frame.light_radiance.rgb * key.visibility;
  radiance = radiance * contact_shade(frame, room_position) + contact_ring(frame, room_position);
  vec3 own_light = emissive.rgb + highlight_glow(s, emissive.a);

  // what is unlit shows its colour as it is
  vec3 shown = mix(tone_map(radiance + own_light), vertex_color.rgb + own_light, parameters.z);

  // what has dissolved is the background
  float gone = haze(frame, room_position);
  if (gone > 0.0) shown = mix(shown, background_color(frame, gl_FragCoord.xy * frame.target_size.zw), gone);

  // premultiplied, so that opaque and blended primitives share this shader
  out_color = vec4(srgb_from_linear(shown) * vertex_color.a, vertex_color.a);
}
