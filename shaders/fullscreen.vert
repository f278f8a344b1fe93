// SPDX-License-Identifier: Apache-2.0
#version 460

// Covers the target with a triangle strip of four vertices, at depth 0: infinitely far with reversed depth. A single
// larger triangle would be clipped, and Mesa 22.3's lavapipe draws clipped triangles in the first view only.
void main() {
  vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);
  gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
