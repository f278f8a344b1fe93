// SPDX-License-Identifier: Apache-2.0
// Values for the current view. Selected instead of indexed: lavapipe reads an indexed uniform lane by lane. With
// AFM_ONE_VIEW the code has one view, and does not require multiview of the device.
#include "frame.glsl"

#ifdef AFM_ONE_VIEW
#define AFM_FIRST_VIEW true
#else
#define AFM_FIRST_VIEW (gl_ViewIndex == 0)
#endif

mat4 view_clip_from_room() {
  return AFM_FIRST_VIEW ? frame.clip_from_room[0] : frame.clip_from_room[1];
}

vec3 view_eye_position() {
  return AFM_FIRST_VIEW ? frame.eye_position[0].xyz : frame.eye_position[1].xyz;
}

// 0 for the left eye's picture, 1 for the right's.
float view_eye() {
  return AFM_FIRST_VIEW ? frame.eye_position[0].w : frame.eye_position[1].w;
}
