// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "tone.glsl"

// Both eyes' images as one picture, in every stereo mode. scene/display/stereo_layout.h defines the source of each
// pixel, and a test compares the two for each mode. The eye images contain sRGB values in a UNORM format: unscaled
// pixels pass through unchanged. Scaling and mixing happen in linear light, through views of the same images that
// decode them.
layout(constant_id = AFM_CONSTANT_VARIANT) const uint kVariant = 0;

layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2DArray eyes;
layout(set = 0, binding = AFM_BINDING_LINEAR) uniform sampler2DArray linear_eyes;
layout(set = 0, binding = AFM_BINDING_ANAGLYPH) uniform Anaglyph { AnaglyphBlock anaglyph; };
layout(set = 1, binding = AFM_BINDING_WARP) uniform sampler2D warp;  // as scene::warp_map()
layout(set = 1, binding = AFM_BINDING_BLEND) uniform Blending { BlendBlock blend; };
layout(push_constant) uniform Compose { ComposeBlock compose; };
layout(location = 0) out vec4 out_color;

// cases of scene::EyeArrangement, in its order, except those that show one eye from corner to corner
const int kRightEye = 1, kSideBySide = 3, kTopBottom = 4, kRows = 5, kColumns = 6, kCheckerboard = 7, kFramePacked = 9;

const int kLeft = 0;
const int kRight = 1;
const int kBlank = 2;

// Pixel of a region covered by one eye's image.
struct Source {
  int eye;
  ivec2 pixel;
  ivec2 region;
};

// First and second of two regions side by side along one axis; leftover pixels stay blank.
Source shared_by_two(ivec2 pixel, ivec2 picture, int axis) {
  ivec2 region = picture;
  region[axis] = max(1, picture[axis] / 2);
  int index = pixel[axis] / region[axis];
  pixel[axis] -= index * region[axis];
  return Source(min(index, kBlank), pixel, region);
}

// Integer lines; a picture of another size shows the nearest of them.
Source frame_packed(ivec2 pixel, ivec2 picture) {
  ivec2 eye = ivec2(textureSize(eyes, 0).x, compose.screen.z);
  int right_begins = eye.y + compose.screen.w;
  vec2 scale = vec2(eye.x, right_begins + eye.y) / vec2(picture);
  ivec2 exact = ivec2((vec2(pixel) + 0.5) * scale);
  if (exact.y < eye.y) {
    return Source(kLeft, exact, eye);
  }
  return exact.y < right_begins ? Source(kBlank, exact, eye) : Source(kRight, exact - ivec2(0, right_begins), eye);
}

Source source_of_pixel(ivec2 pixel, ivec2 picture) {
  ivec2 on_screen = ivec2(gl_FragCoord.xy) + compose.screen.xy;
  switch (compose.mode.x) {
    case kRightEye:
      return Source(kRight, pixel, picture);
    case kSideBySide:
      return shared_by_two(pixel, picture, 0);
    case kTopBottom:
      return shared_by_two(pixel, picture, 1);
    case kRows:
      return Source(on_screen.y & 1, pixel, picture);
    case kColumns:
      return Source(on_screen.x & 1, pixel, picture);
    case kCheckerboard:
      return Source((on_screen.x + on_screen.y) & 1, pixel, picture);
    case kFramePacked:
      return frame_packed(pixel, picture);
    default:
      return Source(kLeft, pixel, picture);
  }
}

int layer_of(int eye) { return eye == kRight && compose.eyes.x == 0 ? 1 : 0; }

// True if the pixel shows its own position in the picture: neither mesh nor keystone moves it.
bool unmoved() { return (kVariant & AFM_FEATURE_WARPED) == 0u && compose.mode.z == 0; }

// True if a pixel of the picture equals one of the eye's image.
bool unscaled(Source source) {
  return unmoved() && source.region == textureSize(eyes, 0).xy;
}

// Content of an output's pixel: a position in the eyes' pictures, from 0,0 to 1,1, or nothing.
struct Place {
  vec2 uv;
  bool shown;
  float intensity;  // factor for the encoded colour
  float line_px;    // distance to the nearest line of the warp mesh
};

Place place_of(Source source) {
  Place place = Place((vec2(source.pixel) + 0.5) / vec2(source.region), true, 1.0, 1e6);
  if ((kVariant & AFM_FEATURE_WARPED) != 0u) {
    vec4 warped = texelFetch(warp, source.pixel, 0);
    place = Place(warped.xy, warped.w > 0.0, warped.z, warped.w - 1.0);
  } else if (compose.mode.z != 0) {
    vec3 moved = compose.picture_from_output[0].xyz * place.uv.x + compose.picture_from_output[1].xyz * place.uv.y +
                 compose.picture_from_output[2].xyz;
    place.uv = moved.xy / moved.z;
    place.shown = moved.z > 0.0;
  }
  place.shown = place.shown && !any(lessThan(place.uv, vec2(0.0))) && !any(greaterThan(place.uv, vec2(1.0)));
  return place;
}

// Unfiltered pixel, encoded.
vec3 eye_texel(int eye, ivec2 pixel) { return texelFetch(eyes, ivec3(pixel, layer_of(eye)), 0).rgb; }

// Exact; the device's own decoding may be off by an 8-bit step.
vec3 linear_from_srgb(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

// Pixel whose centre a warped position hits, within the resolution of a device's filter; negative if there is none.
ivec2 met_by_warp(Place place) {
  const float kFilterSteps = 512.0;  // half a step of an 8-bit filter
  vec2 at = place.uv * vec2(textureSize(eyes, 0).xy) - 0.5;
  vec2 nearest = round(at);
  bool met = (kVariant & AFM_FEATURE_WARPED) != 0u && all(lessThan(abs(at - nearest), vec2(1.0 / kFilterSteps)));
  return met ? ivec2(nearest) : ivec2(-1);
}

// Linear light, bilinear.
vec3 filtered_light(int eye, Place place) {
  return textureLod(linear_eyes, vec3(place.uv, layer_of(eye)), 0.0).rgb;
}

// Linear light; unfiltered if nothing is scaled.
vec3 eye_light(int eye, Source source, Place place) {
  ivec2 met = unscaled(source) ? source.pixel : met_by_warp(place);
  return met.x >= 0 ? linear_from_srgb(eye_texel(eye, met)) : filtered_light(eye, place);
}

// Encoded colour for display.
vec3 eye_color(int eye, Source source, Place place) {
  ivec2 met = unscaled(source) ? source.pixel : met_by_warp(place);
  return met.x >= 0 ? eye_texel(eye, met) : srgb_from_linear(filtered_light(eye, place));
}

// ---- blending: scene::Blend has the same arithmetic ----

float risen(float distance, float begin, float width) {
  if (width <= 0.0) {
    return 1.0;
  }
  float t = clamp((distance - begin) / width, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

vec3 light_of(vec3 encoded) { return blend.light.y > 0.0 ? pow(encoded, vec3(blend.light.y)) : linear_from_srgb(encoded); }

// Exact, because the outputs' rounding errors add up.
vec3 encoded_from(vec3 light) {
  if (blend.light.y > 0.0) {
    return pow(light, vec3(1.0 / blend.light.y));
  }
  return mix(light * 12.92, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055, greaterThan(light, vec3(0.0031308)));
}

// This output's share of the colour at a position, plus the light that raises black there to its level where most
// projectors overlap.
vec3 blended(vec3 color, vec2 uv) {
  float own = 1.0, all_of_them = 0.0, black = 0.0;
  for (int i = 0; i < int(blend.light.x); ++i) {
    vec4 inwards = vec4(uv - blend.box[i].xy, blend.box[i].zw - uv);
    if (any(lessThan(inwards, vec4(0.0)))) {
      continue;
    }
    float weight = 1.0;
    for (int edge = 0; edge < 4; ++edge) {
      weight *= risen(inwards[edge], blend.begin[i][edge], blend.width[i][edge]);
    }
    own = i == 0 ? weight : own;
    all_of_them += weight;
    black += blend.black[i].x;
  }
  float share = all_of_them > 0.0 ? own / all_of_them : 1.0;
  float lift = max(0.0, blend.light.z - black);
  if (share == 1.0 && lift == 0.0 && blend.light.w == 1.0) {
    return color;
  }
  return encoded_from(share * (lift + blend.light.w * light_of(color)));
}

// Adds the lines of the warp mesh to the picture, for setting up.
vec3 marked(vec3 color, Place place) {
  const float kHalfWidthPx = 0.75;
  const vec3 kLine = vec3(1.0, 0.35, 0.75);
  return compose.picture_from_output[0].w > 0.0 && place.line_px <= kHalfWidthPx ? kLine : color;
}

// Black outside the picture.
vec3 corrected(vec3 color, Place place) {
  if (!place.shown) {
    return vec3(0.0);
  }
  if ((kVariant & AFM_FEATURE_BLENDED) != 0u) {
    color = blended(color, place.uv);
  }
  return (kVariant & AFM_FEATURE_WARPED) != 0u ? marked(place.intensity * color, place) : color;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - compose.place.xy;
  Source source = source_of_pixel(pixel, compose.place.zw);
  bool swapped = compose.mode.y != 0;
  vec3 color = vec3(0.0);
  if ((kVariant & AFM_FEATURE_MIXED) != 0u) {
    Place place = place_of(source);
    vec3 left = eye_light(swapped ? kRight : kLeft, source, place);
    vec3 right = eye_light(swapped ? kLeft : kRight, source, place);
    vec3 mixed = mat3(anaglyph.left[compose.mode.w]) * left + mat3(anaglyph.right[compose.mode.w]) * right;
    color = corrected(srgb_from_linear(clamp(mixed, 0.0, 1.0)), place);
  } else if (source.eye != kBlank) {
    int eye = swapped ? kRight - source.eye : source.eye;
    Place place = place_of(source);
    bool scaled = (kVariant & AFM_FEATURE_SCALED) != 0u;
    color = corrected(scaled ? eye_color(eye, source, place) : eye_texel(eye, source.pixel), place);
  }
  out_color = vec4(color, 1.0);
}
