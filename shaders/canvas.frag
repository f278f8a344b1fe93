// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2D font_atlas;
layout(location = 0) in vec2 texture_place;
layout(location = 1) in vec4 ink;
layout(location = 0) out vec4 out_color;

void main() {
  float coverage = ink.a * texture(font_atlas, texture_place).r;
  out_color = vec4(ink.rgb * coverage, coverage);
}
