// SPDX-License-Identifier: Apache-2.0
// Colour of a point on a plain surface, display-linear: per fragment, or per vertex where triangles are about as small
// as pixels. Needs contact.glsl, lighting.glsl and view.glsl. `surface` and `emissive` are those of DrawBlock;
// `normal` is a unit vector towards the viewer.

Surface surface_at(vec3 place, vec3 normal, vec3 color, vec4 surface) {
  float metallic = surface.x;
  return Surface(normal, normalize(view_eye_position() - place), color * (1.0 - metallic),
                 mix(vec3(0.04), color, metallic), surface.y);
}

vec3 own_light(Surface s, vec4 emissive) { return emissive.rgb + highlight_glow(s, emissive.a); }

// Radiance from the studio and the visible share of the key light.
vec3 radiance(Surface s, Lobe lobe, float visibility) {
  Key key = Key(frame.light_direction.xyz, frame.light_side.xyz, visibility);
  return studio_reflection(s, key, lobe) + key_reflection(s, key.axis) * frame.light_radiance.rgb * key.visibility;
}

vec3 shaded(vec3 place, Surface s, vec4 emissive, Lobe lobe, float visibility) {
  return tone_map(shaded_by_contact(place, radiance(s, lobe, visibility)) + own_light(s, emissive));
}
