// SPDX-License-Identifier: Apache-2.0
// A copy of a mesh (render::MeshCopy) in the frame of its node. Vertex attributes that advance with the instance:
// lavapipe reads a storage buffer indexed in the shader lane by lane.
layout(location = 3) in vec4 copy_place;  // w: scale
layout(location = 4) in vec4 copy_turn;   // unit quaternion

vec3 turned(vec3 v) { return v + 2.0 * cross(copy_turn.xyz, cross(copy_turn.xyz, v) + copy_turn.w * v); }

vec3 copy_position(vec3 position) { return copy_place.xyz + copy_place.w * turned(position); }
