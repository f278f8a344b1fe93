// SPDX-License-Identifier: Apache-2.0
// As shadow.vert, for the copies of a mesh.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "frame.glsl"

layout(set = AFM_SET_DRAW, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };

layout(location = 0) in vec3 position;

#include "copy.glsl"

void main() {
  gl_Position = frame.shadow_from_room * draw.room_from_node * vec4(copy_position(position), 1.0);
}
