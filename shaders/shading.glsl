// SPDX-License-Identifier: Apache-2.0
// What a place of a plain surface looks like: by fragment, or by vertex where triangles are about as small as pixels. Needs
// the blocks `frame` and `draw`, contact.glsl, and what key_light.glsl needs. Display-linear; `normal` is a unit vector towards the viewer.
vec3 shaded(vec3 place, vec3 normal, vec3 color, Lobe lobe) {
  vec4 parameters = draw.surface;
  vec4 emissive = draw.emissive;
  vec3 to_eye = normalize(view_eye_position(frame) - place);
  float metallic = parameters.x;
  Surface s = Surface(normal, to_eye, color * (1.0 - metallic), mix(vec3(0.04), color, metallic), parameters.y);
  Key key = Key(frame.light_direction.xyz, frame.light_side.xyz, key_light_visibility());
  vec3 radiance = studio_reflection(s, key, lobe) + key_reflection(s, key.axis) * frame.light_radiance.rgb * key.visibility;
  radiance = radiance * contact_shade(frame, place) + contact_ring(frame, place);
  vec3 own_light = emissive.rgb + highlight_glow(s, emissive.a);

  // what is unlit shows its colour as it is
  return mix(tone_map(radiance + own_light), color + own_light, parameters.z);
}
