// SPDX-License-Identifier: Apache-2.0
// What belongs to the view that is being drawn. Chosen instead of indexed: lavapipe reads an indexed uniform lane by lane.

mat4 view_clip_from_room(FrameBlock frame) {
  return gl_ViewIndex == 0 ? frame.clip_from_room[0] : frame.clip_from_room[1];
}

vec3 view_eye_position(FrameBlock frame) {
  return gl_ViewIndex == 0 ? frame.eye_position[0].xyz : frame.eye_position[1].xyz;
}

// 0 for the left eye's picture, 1 for the right's.
float view_eye(FrameBlock frame) {
  return gl_ViewIndex == 0 ? frame.eye_position[0].w : frame.eye_position[1].w;
}
