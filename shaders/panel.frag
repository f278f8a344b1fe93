// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

layout(set = 1, binding = AFM_BINDING_TEXTURE) uniform sampler2D panel_texture;
layout(location = 0) in vec2 texture_place;
layout(location = 0) out vec4 out_color;

// The texture contains premultiplied sRGB colour like the eye images: text is neither lit nor tone mapped.
void main() { out_color = texture(panel_texture, texture_place); }
