// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "background.glsl"
#include "cone_shade.glsl"
#include "contact.glsl"
#include "frame.glsl"
#include "lighting.glsl"
#include "tone.glsl"
#include "view.glsl"

layout(constant_id = AFM_CONSTANT_VARIANT) const uint kVariant = 0;

layout(set = 0, binding = AFM_BINDING_SHADOW) uniform sampler2D shadow_map;

layout(location = 0) centroid in vec3 front_position;
layout(location = 1) centroid in vec3 room_normal;
layout(location = 2) in vec4 vertex_color;
layout(location = 3) centroid in vec4 front_shadow_place;
layout(location = 4) flat in vec4 lobe;           // border, spread
layout(location = 5) flat in vec4 drawn_surface;  // as DrawBlock::surface; z: 1 with an outline
layout(location = 6) flat in vec4 drawn_emissive;

layout(location = 0) out vec4 out_color;

vec3 room_position, shadow_place;

#include "key_light.glsl"
#include "shadow_place.glsl"
#include "shading.glsl"

// Outline: cosines to the eye between which it grows to its depth.
const float kOutlineBegin = 0.12, kOutlineEnd = 0.48, kOutlineDepth = 0.85;

void main() {
  float whole = 1.0 / front_shadow_place.w;  // see shadow_place.glsl
  room_position = whole * front_position;
  vec3 front = normalize(room_normal);
  vec3 normal = gl_FrontFacing ? front : -front;
  Surface s = surface_at(room_position, normal, vertex_color.rgb, drawn_surface);
  vec3 shown;
  if ((kVariant & AFM_FEATURE_UNLIT) != 0u) {
    shown = vertex_color.rgb + own_light(s, drawn_emissive);
  } else {
    bool has_back = (kVariant & AFM_FEATURE_DOUBLE_SIDED) != 0u;
    shadow_place = has_back ? place_in_shadow_map(room_position, normal, drawn_surface.w) : whole * front_shadow_place.xyz;
    float visible = key_light_visibility();
    if ((kVariant & AFM_FEATURE_FOG) != 0u) {
      visible = mix(1.0, visible, frame.light_direction.w) * past_cone(room_position);
    }
    shown = shaded(room_position, s, drawn_emissive, Lobe(lobe.x, lobe.yzw), visible);
    if ((kVariant & AFM_FEATURE_FOG) != 0u) {
      float turned = 1.0 - smoothstep(kOutlineBegin, kOutlineEnd, dot(s.normal, s.to_eye));
      shown *= 1.0 - drawn_surface.z * kOutlineDepth * turned;
    }
  }

  // fully fogged pixels show the background
  if ((kVariant & AFM_FEATURE_FOG) != 0u) {
    shown = mix(shown, background_color(gl_FragCoord.xy * frame.target_size.zw), fog(room_position));
  }

  // premultiplied, so that opaque and blended primitives share this shader
  out_color = vec4(srgb_from_linear(shown) * vertex_color.a, vertex_color.a);
}
