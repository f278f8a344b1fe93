// SPDX-License-Identifier: Apache-2.0
// What the shaders and render/ agree on; included by both. Only vec4 and mat4 members, so that std140, std430 and C++ lay
// the blocks out alike; render/src/shader_interface.h asserts sizes and offsets. Lengths are metres in the room.
#ifndef AFM_INTERFACE_GLSL_H
#define AFM_INTERFACE_GLSL_H

// set 0, the frame
#define AFM_BINDING_FRAME 0
#define AFM_BINDING_DRAW 1
#define AFM_BINDING_SHADOW 2

// texels each way
#define AFM_SHADOW_MAP_SIZE 2048

// set 1 of the panels, set 0 of the canvas and of the compose pass: what they sample
#define AFM_BINDING_TEXTURE 0
#define AFM_BINDING_RIGHT_EYE 1

// one per frame; what has two elements belongs to the views
struct FrameBlock {
  mat4 clip_from_room[2];
  vec4 eye_position[2];    // xyz
  mat4 shadow_from_room;   // to the shadow map's clip space, depth 0 nearest to the light
  vec4 light_direction;    // xyz: unit vector to the key light
  vec4 light_radiance;     // rgb, linear; a: metres that one texel of the shadow map covers
  vec4 target_size;        // width, height of an eye image in pixels, and their reciprocals
};

// One per primitive that a node shows: a uniform block with a dynamic offset. lavapipe reads a storage buffer that is
// indexed in the shader lane by lane, which made a frame three times as long.
struct DrawBlock {
  mat4 room_from_node;
  vec4 normal_column[3];  // xyz: columns of the normal matrix, scaled so that the longest has length 1
  vec4 base_color;        // linear
  vec4 emissive;          // rgb: linear radiance; a: highlight, 0 or 1
  vec4 surface;           // metallic, roughness, unlit (0 or 1), unused
  vec4 bend;              // 1 / length, end deflection, both in the node's units; 0, 0: not bent; unused, unused
};

// push constants of a panel: the rectangle in the room
struct PanelBlock {
  vec4 lower_left;
  vec4 right;
  vec4 up;
};

// push constants of the canvas that panels are drawn on: clip = pixel * scale - 1
struct CanvasBlock {
  vec4 scale;  // xy
};

// push constants of the compose pass
struct ComposeBlock {
  ivec4 mode;      // x: AFM_LAYOUT_*, y, z: width and height of an eye image in pixels, w: 1: both eyes see the left one's
  vec4 drawn;      // xy: the share of the eye images, from their upper left corner, that is drawn
  vec4 placement;  // xy: where the picture begins in the target, pixels; zw: pixels of the picture to one of the target
};

#define AFM_LAYOUT_LEFT 0
#define AFM_LAYOUT_RIGHT 1
#define AFM_LAYOUT_SIDE_BY_SIDE 2

#endif
