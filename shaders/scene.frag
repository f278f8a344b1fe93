// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "lighting.glsl"
#include "tone.glsl"

layout(set = 0, binding = AFM_BINDING_FRAME, std140) uniform Frame { FrameBlock frame; };
layout(set = 0, binding = AFM_BINDING_DRAWS, std430) readonly buffer Draws { DrawBlock draws[]; };
layout(set = 0, binding = AFM_BINDING_SHADOW) uniform sampler2DShadow shadow_map;

layout(location = 0) in vec3 room_position;
layout(location = 1) in vec3 room_normal;
layout(location = 2) in vec4 vertex_color;
layout(location = 3) flat in int draw_index;

layout(location = 0) out vec4 out_color;

// Share of the key light that arrives: 3x3 bilinear comparisons. Outside the map everything is lit.
float key_light_visibility(vec3 normal) {
  vec2 texel = 1.0 / vec2(textureSize(shadow_map, 0));

  // step off the surface along its normal by about one texel of the map, more where light grazes
  float grazing = 1.0 - max(dot(normal, frame.light_direction.xyz), 0.0);
  vec3 from = room_position + normal * frame.light_radiance.w * (0.5 + 1.5 * grazing);
  vec3 place = (frame.shadow_from_room * vec4(from, 1.0)).xyz;
  vec2 uv = place.xy * 0.5 + 0.5;
  float lit = 0.0;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      lit += texture(shadow_map, vec3(uv + vec2(x, y) * texel, place.z));
    }
  }
  return lit / 9.0;
}

// A chosen thing must be seen from the last row: warm body, bright rim.
vec3 highlight_glow(Surface s, float amount) {
  float rim = 1.0 - max(dot(s.normal, s.to_eye), 0.0);
  return amount * (vec3(1.0, 0.55, 0.12) * (0.16 + 1.6 * rim * rim));
}

void main() {
  vec4 parameters = draws[draw_index].surface;
  vec4 emissive = draws[draw_index].emissive;
  vec3 to_eye = normalize(frame.eye_position[gl_ViewIndex].xyz - room_position);
  vec3 normal = normalize(room_normal);
  normal = gl_FrontFacing ? normal : -normal;

  float metallic = parameters.x;
  Surface s = Surface(normal, to_eye, vertex_color.rgb * (1.0 - metallic), mix(vec3(0.04), vertex_color.rgb, metallic),
                      parameters.y);
  vec3 light = frame.light_direction.xyz;
  vec3 radiance = studio_reflection(s, light) +
                  key_reflection(s, light) * frame.light_radiance.rgb * key_light_visibility(normal);
  radiance = mix(radiance, vertex_color.rgb, parameters.z) + emissive.rgb + highlight_glow(s, emissive.a);

  // premultiplied, so that opaque and blended primitives share this shader
  out_color = vec4(tone_map(radiance) * vertex_color.a, vertex_color.a);
}
