// SPDX-License-Identifier: Apache-2.0
// Materials with textures or extensions: glTF 2.0, appendix B, in the same studio as scene.frag.
#version 460
#extension GL_EXT_multiview : require
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "background.glsl"
#include "contact.glsl"
#include "frame.glsl"
#include "lighting.glsl"
#include "thin_film.glsl"
#include "tone.glsl"
#include "view.glsl"

layout(constant_id = AFM_CONSTANT_VARIANT) const uint kVariant = 0;

layout(set = 0, binding = AFM_BINDING_SHADOW) uniform sampler2D shadow_map;

// in the order of scene::TextureSlot
const int kBaseColor = 0, kMetallicRoughness = 1, kNormal = 2, kOcclusion = 3, kEmissive = 4, kSpecular = 5,
          kSpecularColor = 6, kClearcoat = 7, kClearcoatRoughness = 8, kClearcoatNormal = 9, kIridescence = 10,
          kIridescenceThickness = 11;
const int kTextureSlots = 12;

// the features of scene::kPbrFields, in their order
const int kClearcoatFeature = 0, kIridescenceFeature = 1;

// Properties of scene::PbrMaterial not in DrawBlock: the fields of scene::kPbrFields that are not Plain, in order, and
// two rows per slot: xyz maps (u, v, 1); w of the first row: set 0 or 1.
layout(set = AFM_SET_MATERIAL, binding = AFM_BINDING_MATERIAL, std140) uniform Material {
  vec4 alpha_cutoff;
  vec4 normal_scale;
  vec4 occlusion_strength;
  vec4 ior;
  vec4 specular;
  vec4 specular_color;
  vec4 clearcoat;
  vec4 clearcoat_roughness;
  vec4 clearcoat_normal_scale;
  vec4 iridescence;
  vec4 iridescence_ior;
  vec4 iridescence_thickness_nm;  // thickness at texture values 0 and 1
  vec4 uv_rows[2 * kTextureSlots];
} material;
layout(set = AFM_SET_MATERIAL, binding = AFM_BINDING_TEXTURES) uniform sampler2D textures[kTextureSlots];

layout(location = 0) in vec3 room_position;
layout(location = 1) centroid in vec3 room_normal;
layout(location = 2) in vec4 vertex_color;
layout(location = 3) centroid in vec4 front_shadow_place;
layout(location = 4) in vec4 room_tangent;
layout(location = 5) in vec4 texture_coordinates;
layout(location = 6) flat in vec4 drawn_surface;  // as DrawBlock::surface
layout(location = 7) flat in vec4 drawn_emissive;

layout(location = 0) out vec4 out_color;

vec3 shadow_place;

#include "key_light.glsl"
#include "shadow_place.glsl"

bool enabled(uint bit) { return (kVariant & bit) != 0u; }
bool has(int feature) { return enabled(1u << (AFM_FIRST_PBR_FEATURE + feature)); }

// Reflectance at normal incidence; in KHR_materials_ior, 0 means a mirror.
float reflectance(float ior) {
  float ratio = (ior - 1.0) / (ior + 1.0);
  return ratio * ratio;
}

vec2 place_in(int slot) {
  vec4 row = material.uv_rows[2 * slot];
  vec3 uv = vec3(row.w > 0.5 ? texture_coordinates.zw : texture_coordinates.xy, 1.0);
  return vec2(dot(row.xyz, uv), dot(material.uv_rows[2 * slot + 1].xyz, uv));
}

// White if the material has no such texture. Every index is constant, so that the compiler removes the others.
#define AFM_TEXEL(slot) (enabled(1u << slot) ? texture(textures[slot], place_in(slot)) : vec4(1.0))

// Normal from a texture, in the frame of the vertices' tangents or, without them, of the texture's own coordinates
// across the pixel: dP/du, and its perpendicular on the side of decreasing v.
vec3 mapped_normal(vec3 normal, vec3 texel, float scale, vec2 uv) {
  vec3 tangent = room_tangent.xyz;
  float side = room_tangent.w;
  if (!enabled(AFM_FEATURE_TANGENTS)) {
    vec3 dx = dFdx(room_position), dy = dFdy(room_position);
    vec2 uv_dx = dFdx(uv), uv_dy = dFdy(uv);
    float area = uv_dx.x * uv_dy.y - uv_dy.x * uv_dx.y;
    float turn = area < 0.0 ? -1.0 : 1.0;
    tangent = turn * (uv_dy.y * dx - uv_dx.y * dy);
    side = dot(cross(tangent, turn * (uv_dx.x * dy - uv_dy.x * dx)), normal) < 0.0 ? 1.0 : -1.0;
  }
  tangent -= normal * dot(normal, tangent);
  if (dot(tangent, tangent) < 1e-24) {
    return normal;
  }
  tangent = normalize(tangent);
  vec3 local = (texel * 2.0 - 1.0) * vec3(scale, scale, 1.0);
  return normalize(tangent * local.x + cross(normal, tangent) * side * local.y + normal * local.z);
}

// KHR_lights_punctual: inverse square, windowed to the range; the cone's cosine by a scale and an offset.
vec3 punctual_light(int i, out vec3 to_light) {
  vec4 position = frame.punctual_position[i];
  vec4 direction = frame.punctual_direction[i];
  vec4 cone = frame.punctual_cone[i];
  to_light = -direction.xyz;
  float strength = 1.0;
  if (direction.w > 0.5) {
    vec3 away = position.xyz - room_position;
    float distance2 = max(dot(away, away), 1e-12);
    float within = distance2 * position.w * position.w;
    to_light = away * inversesqrt(distance2);
    strength = clamp(1.0 - within * within, 0.0, 1.0) / distance2;
    float angle = clamp(dot(direction.xyz, -to_light) * cone.x + cone.y, 0.0, 1.0);
    strength *= angle * angle;
  }
  return frame.punctual_intensity[i].rgb * strength;
}

// Total light from a surface to the eye.
vec3 lit(Surface s, Key key, float occlusion) {
  vec3 radiance = occlusion * studio_reflection(s, key, lobe_of(s.roughness)) +
                  key_reflection(s, key.axis) * frame.light_radiance.rgb * key.visibility;
  if (enabled(AFM_FEATURE_LIGHTS)) {
    for (int i = 0; i < int(frame.punctual_count.x); ++i) {
      vec3 to_light;
      vec3 light = punctual_light(i, to_light);
      radiance += light * key_reflection(s, to_light);
    }
  }
  return radiance;
}

// Writes a premultiplied colour. Discards masked pixels last, because their derivatives are used to filter the
// neighbours' textures.
void put(vec3 shown, float coverage) {
  if (enabled(AFM_FEATURE_MASK) && coverage < material.alpha_cutoff.x) {
    discard;
  }
  float alpha = enabled(AFM_FEATURE_BLEND) ? coverage : 1.0;
  out_color = vec4(srgb_from_linear(shown) * alpha, alpha);
}

void main() {
  vec4 color = vertex_color * AFM_TEXEL(kBaseColor);
  vec3 emitted = drawn_emissive.rgb * AFM_TEXEL(kEmissive).rgb;
  vec3 to_eye = normalize(view_eye_position() - room_position);
  vec3 front = normalize(room_normal);
  float facing = gl_FrontFacing ? 1.0 : -1.0;  // a back has its front's normal reversed, bent or not
  vec3 normal = facing * front;
  shadow_place = front_shadow_place.xyz / front_shadow_place.w;
  if (enabled(AFM_FEATURE_DOUBLE_SIDED)) shadow_place = place_in_shadow_map(room_position, normal, drawn_surface.w);
  if (enabled(1u << kNormal)) {
    normal = facing * mapped_normal(front, AFM_TEXEL(kNormal).xyz, material.normal_scale.x, place_in(kNormal));
  }

  vec4 metal_rough = AFM_TEXEL(kMetallicRoughness);
  float metallic = drawn_surface.x * metal_rough.b;
  float roughness = drawn_surface.y * metal_rough.g;
  vec3 dielectric = min(reflectance(material.ior.x) * material.specular_color.rgb * AFM_TEXEL(kSpecularColor).rgb, vec3(1.0)) *
                    material.specular.x * AFM_TEXEL(kSpecular).a;
  Surface s = Surface(normal, to_eye, color.rgb * (1.0 - metallic), mix(dielectric, color.rgb, metallic), roughness);
  vec3 own_light = emitted + highlight_glow(s, drawn_emissive.a);
  if (enabled(AFM_FEATURE_UNLIT)) {
    put(min(color.rgb + own_light, vec3(1.0)), color.a);
    return;
  }

  if (has(kIridescenceFeature)) {
    float share = material.iridescence.x * AFM_TEXEL(kIridescence).r;
    float nm = mix(material.iridescence_thickness_nm.x, material.iridescence_thickness_nm.y, AFM_TEXEL(kIridescenceThickness).g);
    vec3 film = thin_film_reflectance(material.iridescence_ior.x, max(dot(normal, to_eye), 1e-3), nm * 1e-9, s.specular);
    s.specular = mix(s.specular, film, share);
  }
  Key key = Key(frame.light_direction.xyz, frame.light_side.xyz, key_light_visibility());
  float occlusion = mix(1.0, AFM_TEXEL(kOcclusion).r, material.occlusion_strength.x);
  vec3 radiance = lit(s, key, occlusion) + emitted;
  if (has(kClearcoatFeature)) {
    vec3 coat_normal = facing * front;
    if (enabled(1u << kClearcoatNormal)) {
      coat_normal = facing * mapped_normal(front, AFM_TEXEL(kClearcoatNormal).xyz, material.clearcoat_normal_scale.x,
                                           place_in(kClearcoatNormal));
    }
    float coat = material.clearcoat.x * AFM_TEXEL(kClearcoat).r;
    float coat_roughness = material.clearcoat_roughness.x * AFM_TEXEL(kClearcoatRoughness).g;
    float through = 1.0 - coat * schlick(vec3(0.04), max(dot(coat_normal, to_eye), 0.0)).x;
    Surface lacquer = Surface(coat_normal, to_eye, vec3(0.0), vec3(0.04), coat_roughness);
    radiance = radiance * through + coat * lit(lacquer, key, occlusion);
  }
  put(tone_map(radiance + highlight_glow(s, drawn_emissive.a)), color.a);
}
