// SPDX-License-Identifier: Apache-2.0
// Shared by the shaders and render/. Blocks contain only vectors of four and 4x4 matrices, so that std140, std430 and
// C++ have the same layout; render/src/device/shader_interface.h asserts sizes and offsets. Lengths are metres in the
// room.
#ifndef AFM_INTERFACE_GLSL_H
#define AFM_INTERFACE_GLSL_H

// set 0, the frame
#define AFM_BINDING_FRAME 0
#define AFM_BINDING_SHADOW 1

// Set of the draw, for vertices only. Nothing else changes from node to node: after any change of uniforms, textures or
// samplers of fragments, lavapipe copies their whole state, 30 kB.
#define AFM_SET_DRAW 1
#define AFM_BINDING_DRAW 0

// specialisation constants: features of the pipeline, and true for one light without shadow
#define AFM_CONSTANT_VARIANT 0
#define AFM_CONSTANT_ONE_LIGHT 1

// in front of everything; depth is reversed
#define AFM_FRONT_DEPTH 0.9999

// set of materials with textures or extensions
#define AFM_SET_MATERIAL 2
#define AFM_BINDING_MATERIAL 0
#define AFM_BINDING_TEXTURES 1

#define AFM_MOST_LIGHTS 16

// Features of a pipeline for such materials. The bits 1 << slot: samples these textures. From AFM_FIRST_PBR_FEATURE:
// the features of scene::kPbrFields, in order.
#define AFM_FIRST_PBR_FEATURE 18
#define AFM_MOST_PBR_FEATURES 8
#define AFM_FEATURE_TANGENTS 0x04000000u  // the vertices have tangents
#define AFM_FEATURE_UNLIT 0x08000000u
#define AFM_FEATURE_MASK 0x10000000u    // alphaMode MASK
#define AFM_FEATURE_BLEND 0x20000000u   // alphaMode BLEND
#define AFM_FEATURE_LIGHTS 0x40000000u  // the scene contains lights

// Plain materials too: looks up the shadow on a back a step off the back instead of the front.
#define AFM_FEATURE_DOUBLE_SIDED 0x80000000u

// Features of a pipeline for plain materials: fog and, with AFM_FEATURE_UNLIT, no lighting. A CPU device executes
// skipped branches too, so they are separate pipelines.
#define AFM_FEATURE_FOG 0x1u

// Half the width of the soft edge in the reflection of a surface of that roughness, radians.
#define AFM_LOBE_BORDER(roughness) (0.04 + 0.9 * (roughness) * (roughness) + 0.25 * (roughness))

// points: metres in the room, and pixels
#define AFM_POINT_SIZE 0.006
#define AFM_SMALLEST_POINT 2
#define AFM_LARGEST_POINT 16

// texels each way: of the shadow map, and of the map with soft edges
#define AFM_SHADOW_MAP_SIZE 1024
#define AFM_SOFT_SHADOW_SIZE 512

// Half the width of a shadow's edge for each metre between the caster and the surface, and most of it, in texels.
#define AFM_PENUMBRA 0.16
#define AFM_PENUMBRA_REACH 3

// set 1 of the panels, set 0 of the canvas and of the compose pass: textures to sample
#define AFM_BINDING_TEXTURE 0
#define AFM_BINDING_RIGHT_EYE 1
#define AFM_BINDING_ANAGLYPH 2
#define AFM_BINDING_LINEAR 3
#define AFM_BINDING_DEPTH_RANGE 2
#define AFM_BINDING_ROOM_DEPTH 1

// set 1 of the compose pass: corrections for an output's projector
#define AFM_BINDING_WARP 0
#define AFM_BINDING_BLEND 1

// one per frame; arrays of two elements are indexed by view
struct FrameBlock {
  mat4 clip_from_room[2];
  vec4 eye_position[2];   // xyz; w: 0 left, 1 right
  mat4 shadow_from_room;  // transform to the shadow map's clip space, depth 0 nearest to the light
  vec4 light_direction;   // xyz: unit vector to the key light; w: strength of the map's shadow
  vec4 light_side;        // xyz: unit, horizontal, across the light's direction
  vec4 light_radiance;    // rgb, linear; a: metres that one texel of the shadow map covers
  vec4 target_size;       // width, height of an eye image in pixels, and their reciprocals
  vec4 contact;           // xyz: contact of tip and sample; w: 1 / radius of the shade there; far away without one
  vec4 contact_ring;      // rgb: linear radiance, 0 without a ring; a: its radius in radii of the shade
  vec4 cone_apex;         // xyz: lowest point of the cone that shades; w: radius of its rounded end
  vec4 cone_axis;         // xyz: unit, into the cone; w: growth of the radius along it
  vec4 cone_reach;        // x: height; y: strength, 0 without a cone
  vec4 fog;               // x: begin, y: 1 / (end - begin), 0 without a range; z: fade; w: 1 with a range
  vec4 screen[3];         // xyz: direction from between the eyes to the upper left corner of the eye images, and the
                          // vectors from there to the upper right and to the lower left corner
  vec4 fog_axis;          // distance beyond the fog's origin, in its units: dot(axis, (place, 1))
  vec4 punctual_count;  // x: number of the lights below; y: largest point of the device in pixels; z: guard band of the
                        // view
  vec4 punctual_position[AFM_MOST_LIGHTS];   // xyz; w: 1 / range, 0 without end
  vec4 punctual_direction[AFM_MOST_LIGHTS];  // xyz: unit, along the rays; w: 0 directional, 1 all others
  vec4 punctual_intensity[AFM_MOST_LIGHTS];  // rgb
  vec4 punctual_cone[AFM_MOST_LIGHTS];       // x scale and y offset of the cosine to the direction; 0, 1: all around
};

// One per primitive of a node: a uniform block with a dynamic offset. lavapipe reads a storage buffer indexed in the
// shader lane by lane, which tripled the frame time. Fragments get what they need of it from the vertices, as flat
// inputs.
struct DrawBlock {
  mat4 room_from_node;
  vec4 normal_column[3];  // xyz: columns of the normal matrix, scaled so that the longest has length 1
  vec4 base_color;        // linear
  vec4 emissive;          // rgb: linear radiance; a: highlight, 0 or 1
  vec4 surface;           // metallic, roughness, unlit (0 or 1), 1: nothing casts a shadow on it
  vec4 bend;              // 1 / length, end deflection, in the node's units; 0, 0: not bent; z: 1 with an outline
};

// push constants of a panel: the rectangle in the room
struct PanelBlock {
  vec4 lower_left;  // w: 0 or 1: only in the left or the right eye's picture, -1: in both
  vec4 right;
  vec4 up;
};

// push constants of the canvas that panels are drawn on: clip = pixel * scale - 1
struct CanvasBlock {
  vec4 scale;  // xy
};

// push constants of the pass that enlarges a room drawn with fewer pixels
struct EnlargeBlock {
  vec4 drawn;   // xy: drawn pixels per pixel of an eye's image, zw: size of the drawn part in pixels
  ivec4 layer;  // x: layer of the eye, for a pass of one eye
};

// push constants of the compose pass; sizes and positions in pixels
struct ComposeBlock {
  ivec4 mode;    // x: scene::EyeArrangement, y: 1 swaps the eyes, z: 1 for a keystone, w: index of the anaglyph
  ivec4 eyes;    // x: 1: the right eye sees the left image
  ivec4 place;   // xy: first pixel of the picture in the target, zw: its size
  ivec4 screen;  // xy: screen position of the target's first pixel; z: lines of a packed eye, w: lines between
  vec4 picture_from_output[3];  // xyz: columns of the keystone; w of the first: 1 shows the lines of the warp mesh
};

// Features of a pipeline of the compose pass. Modes are not among them, because they change at run time.
#define AFM_FEATURE_SCALED 0x1u  // pictures with a size other than the eyes', and keystones
#define AFM_FEATURE_MIXED 0x2u   // anaglyphs
#define AFM_FEATURE_WARPED 0x4u  // positions come from the warp map, not from the pixel
#define AFM_FEATURE_BLENDED 0x8u
#define AFM_COMPOSE_VARIANTS 16

// scene::Blend: boxes and ramps in unit coordinates of the picture, by left, top, right, bottom edge
#define AFM_MOST_BLENDED 9
struct BlendBlock {
  vec4 box[AFM_MOST_BLENDED];    // xy: low, zw: high corner
  vec4 begin[AFM_MOST_BLENDED];  // ramp starts, inwards from the edges
  vec4 width[AFM_MOST_BLENDED];
  vec4 black[AFM_MOST_BLENDED];  // x: luminance of the projector's black
  vec4 light;  // x: number of boxes, the output's own first; y: gamma, 0: sRGB; z: brightest black; w: picture's share
};

// linear rgb = left * L + right * R: the upper left 3 x 3
#define AFM_MOST_ANAGLYPHS 8
struct AnaglyphBlock {
  mat4 left[AFM_MOST_ANAGLYPHS];
  mat4 right[AFM_MOST_ANAGLYPHS];
};

#endif
