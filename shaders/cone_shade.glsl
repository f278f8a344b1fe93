// SPDX-License-Identifier: Apache-2.0
// Share of the key light that arrives past a cone on its rounded end. Of the balls along the cone's axis, the one that
// the ray to the light passes nearest covers part of the softbox. The soft edge is as wide as the softbox seen from
// there, so the shade looks the same at every scale.
#include "frame.glsl"

const float kConeSoftness = 0.32;  // half the softbox's width, as a tangent

float past_cone(vec3 place) {
  vec3 light = frame.light_direction.xyz, axis = frame.cone_axis.xyz;
  vec3 from = place - frame.cone_apex.xyz;

  // where on the axis, from the rounded end's centre up
  float tilt = dot(light, axis);
  float up = (dot(from, axis) - tilt * dot(from, light)) / max(1.0 - tilt * tilt, 1e-3);
  float least = frame.cone_apex.w;
  up = clamp(up, least, max(frame.cone_reach.x, least));

  vec3 to_ball = axis * up - from;
  float along = dot(to_ball, light);
  float miss = sqrt(max(dot(to_ball, to_ball) - along * along, 0.0));
  float radius = least + frame.cone_axis.w * (up - least);
  float soft = max(kConeSoftness * along, 1e-6);
  float covered = smoothstep(-soft, soft, radius - miss);

  // the cone's own skin is no shade for itself
  float ahead = smoothstep(0.25 * radius, 0.9 * radius + 1e-6, along);
  return 1.0 - frame.cone_reach.y * covered * ahead;
}
