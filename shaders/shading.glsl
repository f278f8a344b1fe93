// SPDX-License-Identifier: Apache-2.0
// Colour of a point on a plain surface, display-linear: per fragment, or per vertex where triangles are about as small
// as pixels. Needs the blocks `frame` and `draw`, contact.glsl and lighting.glsl. `normal` is a unit vector towards the
// viewer.

Surface surface_at(vec3 place, vec3 normal, vec3 color) {
  float metallic = draw.surface.x;
  return Surface(normal, normalize(view_eye_position(frame) - place), color * (1.0 - metallic),
                 mix(vec3(0.04), color, metallic), draw.surface.y);
}

vec3 own_light(Surface s) { return draw.emissive.rgb + highlight_glow(s, draw.emissive.a); }

// Radiance from the studio and the visible share of the key light.
vec3 radiance(Surface s, Lobe lobe, float visibility) {
  Key key = Key(frame.light_direction.xyz, frame.light_side.xyz, visibility);
  return studio_reflection(s, key, lobe) + key_reflection(s, key.axis) * frame.light_radiance.rgb * key.visibility;
}

vec3 shaded(vec3 place, Surface s, Lobe lobe, float visibility) {
  return tone_map(shaded_by_contact(frame, place, radiance(s, lobe, visibility)) + own_light(s));
}
