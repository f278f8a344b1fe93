// SPDX-License-Identifier: Apache-2.0
// As shadow.vert, for the copies of a mesh.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"

layout(set = 0, binding = AFM_BINDING_FRAME, std140) uniform Frame { FrameBlock frame; };
layout(set = AFM_SET_DRAW, binding = AFM_BINDING_DRAW, std140) uniform Draw { DrawBlock draw; };

layout(location = 0) in vec3 position;

#include "copy.glsl"

void main() {
  gl_Position = frame.shadow_from_room * draw.room_from_node * vec4(copy_position(position), 1.0);
}
