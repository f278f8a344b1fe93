// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "beam.glsl"
#include "frame.glsl"

layout(set = AFM_SET_DRAW, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };

layout(location = 0) in vec3 position;

void main() {
  vec3 bent = position + vec3(0.0, 0.0, beam_deflection(draw.bend, position.x));
  gl_Position = frame.shadow_from_room * draw.room_from_node * vec4(bent, 1.0);
}
