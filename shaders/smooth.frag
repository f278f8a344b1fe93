// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "contact.glsl"
#include "frame.glsl"
#include "tone.glsl"

layout(set = 0, binding = AFM_BINDING_SHADOW) uniform sampler2D shadow_map;

layout(location = 0) in vec3 room_position;
layout(location = 1) in vec3 shadow_place;
layout(location = 2) in vec3 radiance_in_shadow;
layout(location = 3) in vec3 radiance_in_light;
layout(location = 4) in vec4 own;

layout(location = 0) out vec4 out_color;

#include "key_light.glsl"

void main() {
  vec3 radiance = mix(radiance_in_shadow, radiance_in_light, key_light_visibility());
  vec3 shown = tone_map(shaded_by_contact(room_position, radiance) + own.rgb);
  out_color = vec4(srgb_from_linear(shown) * own.a, own.a);
}
