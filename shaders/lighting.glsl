// SPDX-License-Identifier: Apache-2.0
// Surfaces and the studio around them. The studio is analytic (a gradient sky and three softboxes), because on a CPU
// device texture filtering, not arithmetic, costs time.

#include "one_light.glsl"

const float kPi = 3.14159265;

struct Surface {
  vec3 normal;      // unit, room
  vec3 to_eye;      // unit, room
  vec3 diffuse;     // diffuse albedo
  vec3 specular;    // reflectance at normal incidence
  float roughness;  // perceptual, as in glTF
};

// Effect of roughness on the softboxes: a wider lobe sees a wider, dimmer rectangle.
struct Lobe {
  float border;  // half the width of a rectangle's soft edge
  vec3 spread;   // brightness of the key's, the rim's and the back's rectangle
};

const vec2 kKeyHalfSize = vec2(0.75, 0.42);
const vec2 kRimHalfSize = vec2(0.22, 1.10);
const vec2 kBackHalfSize = vec2(1.10, 0.20);

float spread_of(vec2 half_size, float border) {
  vec2 wider = max(half_size, vec2(border));
  return half_size.x * half_size.y / (wider.x * wider.y);
}

Lobe lobe_of(float roughness) {
  float border = AFM_LOBE_BORDER(roughness);
  return Lobe(border, vec3(spread_of(kKeyHalfSize, border), spread_of(kRimHalfSize, border),
                           spread_of(kBackHalfSize, border)));
}

// Distant rectangle of light, upright about its axis: its brightness in `direction`.
float softbox(vec3 direction, vec3 axis, vec3 side, vec2 half_size, float border) {
  vec3 top = cross(axis, side);
  float facing = dot(direction, axis);
  vec2 place = abs(vec2(dot(direction, side), dot(direction, top))) * (1.0 / max(facing, 0.05));
  vec2 inside = clamp((half_size + border - place) * (0.5 / border), 0.0, 1.0);
  inside = inside * inside * (3.0 - 2.0 * inside);
  return facing > 0.05 ? inside.x * inside.y : 0.0;
}

const vec3 kBackAxis = vec3(-0.2140, 0.4708, -0.8559);
const vec3 kRimAxis = vec3(0.5298, 0.3974, -0.7492);
const vec3 kBackSide = vec3(-0.9701, 0.0, 0.2425);  // normalize(cross(up, axis)), as Key::side
const vec3 kRimSide = vec3(-0.8165, 0.0, -0.5774);
const vec3 kKeyTint = vec3(1.00, 0.94, 0.85);
const vec3 kRimTint = vec3(0.88, 0.94, 1.00);
const vec3 kBackTint = vec3(1.00, 0.97, 0.92);

// Key light and its softbox: position, and the share visible from the surface. A shadow also blocks most of the
// softbox, which gives depth to shadowed areas.
struct Key {
  vec3 axis;
  vec3 side;  // horizontal, unit, across the axis
  float visibility;
};

// Radiance from `direction`, averaged over the lobe of a surface of that roughness.
vec3 studio_radiance(vec3 direction, Key key, float roughness, Lobe lobe) {
  float blur = 0.10 + 0.8 * roughness;
  vec3 sky = mix(vec3(0.78, 0.72, 0.66), vec3(0.20, 0.22, 0.26), smoothstep(-0.1, 0.75, direction.y));
  vec3 radiance = mix(vec3(0.120, 0.104, 0.088), sky, smoothstep(-blur, blur, direction.y));
  radiance += kKeyTint * ((0.6 + 2.6 * key.visibility) * lobe.spread.x *
                          softbox(direction, key.axis, key.side, kKeyHalfSize, lobe.border));
  radiance += kRimTint * (1.5 * lobe.spread.y * softbox(direction, kRimAxis, kRimSide, kRimHalfSize, lobe.border));
  radiance += kBackTint * (1.0 * lobe.spread.z * softbox(direction, kBackAxis, kBackSide, kBackHalfSize, lobe.border));
  return radiance;
}

// The same studio averaged over the cosine lobe of a diffuse surface. The squared wrapped cosine of a far softbox stays
// within a few percent of the integral for boxes of this size.
vec3 studio_irradiance(vec3 normal, Key key) {
  vec3 light = mix(vec3(0.055, 0.053, 0.052), vec3(0.195, 0.205, 0.225), 0.5 + 0.5 * normal.y);
  float toward_key = 0.5 + 0.5 * dot(normal, key.axis);
  float toward_rim = 0.5 + 0.5 * dot(normal, kRimAxis);
  float toward_back = 0.5 + 0.5 * dot(normal, kBackAxis);
  return light + kKeyTint * (0.10 + 0.20 * key.visibility) * toward_key * toward_key +
         kRimTint * 0.13 * toward_rim * toward_rim + kBackTint * 0.06 * toward_back * toward_back;
}

// Directional albedo of GGX by B. Karis's fit ("Physically Based Shading on Mobile", 2014) of D. Lazarov's.
vec3 specular_albedo(vec3 specular, float roughness, float n_dot_v) {
  const vec4 c0 = vec4(-1.0, -0.0275, -0.572, 0.022);
  const vec4 c1 = vec4(1.0, 0.0425, 1.04, -0.04);
  vec4 r = roughness * c0 + c1;
  float a004 = min(r.x * r.x, exp2(-9.28 * n_dot_v)) * r.x + r.y;
  vec2 ab = vec2(-1.04, 1.04) * a004 + r.zw;
  return specular * ab.x + ab.y;
}

// GGX with the height-correlated Smith term in E. Hammon's approximation (GDC 2017) and Schlick's Fresnel term; times
// n.l, for unit radiance of a distant light.
vec3 key_reflection(Surface s, vec3 to_light) {
  vec3 h = normalize(to_light + s.to_eye);
  float n_dot_l = max(dot(s.normal, to_light), 0.0);
  float n_dot_v = max(dot(s.normal, s.to_eye), 1e-3);
  float n_dot_h = max(dot(s.normal, h), 0.0);
  float v_dot_h = max(dot(s.to_eye, h), 0.0);
  float alpha = max(s.roughness * s.roughness, 0.01);
  float alpha2 = alpha * alpha;
  float d = n_dot_h * n_dot_h * (alpha2 - 1.0) + 1.0;
  float distribution_visibility = 0.5 * alpha2 / (kPi * d * d * mix(2.0 * n_dot_l * n_dot_v, n_dot_l + n_dot_v, alpha));
  float grazing = 1.0 - v_dot_h;
  float grazing2 = grazing * grazing;
  vec3 fresnel = s.specular + (1.0 - s.specular) * grazing2 * grazing2 * grazing;
  return ((1.0 - fresnel) * s.diffuse / kPi + min(distribution_visibility, 12.0) * fresnel) * n_dot_l;
}

vec3 studio_reflection(Surface s, Key key, Lobe lobe) {
  if (kOneLight) return kEvenLight * (s.diffuse + s.specular);
  float n_dot_v = max(dot(s.normal, s.to_eye), 0.0);
  vec3 reflected = reflect(-s.to_eye, s.normal);
  return s.diffuse * studio_irradiance(s.normal, key) +
         specular_albedo(s.specular, s.roughness, n_dot_v) * studio_radiance(reflected, key, s.roughness, lobe);
}

// Makes a selected object visible from the last row: warm body, bright rim.
vec3 highlight_glow(Surface s, float amount) {
  float rim = 1.0 - max(dot(s.normal, s.to_eye), 0.0);
  return amount * (vec3(1.0, 0.55, 0.12) * (0.16 + 1.6 * rim * rim));
}
