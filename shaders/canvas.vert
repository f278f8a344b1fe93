// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

layout(push_constant) uniform Canvas { CanvasBlock canvas; };
layout(location = 0) in vec2 position;  // pixels, y down
layout(location = 1) in vec2 atlas_place;
layout(location = 2) in vec4 color;  // sRGB, straight alpha

layout(location = 0) out vec2 texture_place;
layout(location = 1) out vec4 linear_color;

vec3 linear_from_srgb(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

void main() {
  texture_place = atlas_place;
  linear_color = vec4(linear_from_srgb(color.rgb), color.a);
  gl_Position = vec4(position * canvas.scale.xy - 1.0, 0.0, 1.0);
}
