// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "interface.glsl.h"
#include "tone.glsl"

// Both eyes' images as one picture, every stereo mode: scene/display/stereo_layout.h says which pixel shows what, and a test compares
// the two for each. The eye images hold sRGB values in a UNORM format: bytes go through unchanged where one pixel is one
// pixel. What is scaled is so in linear light, through views of the same images that decode them, and so is what is mixed.
layout(constant_id = 0) const uint kVariant = 0;

layout(set = 0, binding = AFM_BINDING_TEXTURE) uniform sampler2DArray eyes;
layout(set = 0, binding = AFM_BINDING_LINEAR) uniform sampler2DArray linear_eyes;
layout(set = 0, binding = AFM_BINDING_ANAGLYPH) uniform Anaglyph { AnaglyphBlock anaglyph; };
layout(push_constant) uniform Compose { ComposeBlock compose; };
layout(location = 0) out vec4 out_color;

// the cases of scene::EyeArrangement, in its order; what shows one eye from corner to corner needs none
const int kRightEye = 1, kSideBySide = 3, kTopBottom = 4, kRows = 5, kColumns = 6, kCheckerboard = 7, kFramePacked = 9;

const int kLeft = 0;
const int kRight = 1;
const int kBlank = 2;

// A pixel of a region that one eye's image fills.
struct Source {
  int eye;
  ivec2 pixel;
  ivec2 region;
};

// The first of two regions beside each other along one axis, and the second; what is left over stays blank.
Source shared_by_two(ivec2 pixel, ivec2 picture, int axis) {
  ivec2 region = picture;
  region[axis] = max(1, picture[axis] / 2);
  int index = pixel[axis] / region[axis];
  pixel[axis] -= index * region[axis];
  return Source(min(index, kBlank), pixel, region);
}

// Whole lines; a picture of another size shows the nearest of them.
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

int layer_of(int eye) { return eye == kRight && compose.drawn.z == 0.0 ? 1 : 0; }

// Whether one pixel of the picture is one of the eye's image.
bool unscaled(Source source) {
  return compose.mode.z == 0 && source.region == textureSize(eyes, 0).xy && compose.drawn.xy == vec2(1.0);
}

// The pixel itself, encoded.
vec3 eye_texel(int eye, Source source) { return texelFetch(eyes, ivec3(source.pixel, layer_of(eye)), 0).rgb; }

// Exactly; the device's own decoding may be off by a step of 8 bits.
vec3 linear_from_srgb(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045)));
}

// Linear light: of the pixel itself where nothing is scaled, else bilinear within what is drawn of the image.
vec3 eye_light(int eye, Source source) {
  if (unscaled(source)) {
    return linear_from_srgb(eye_texel(eye, source));
  }
  vec2 uv = (vec2(source.pixel) + 0.5) / vec2(source.region);
  if (compose.mode.z != 0) {
    vec3 place = compose.picture_from_output[0].xyz * uv.x + compose.picture_from_output[1].xyz * uv.y +
                 compose.picture_from_output[2].xyz;
    uv = place.xy / place.z;
    if (place.z <= 0.0 || any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) {
      return vec3(0.0);
    }
  }
  uv = min(uv * compose.drawn.xy, compose.drawn.xy - (0.5 + compose.drawn.w) / vec2(textureSize(eyes, 0).xy));
  return textureLod(linear_eyes, vec3(uv, layer_of(eye)), 0.0).rgb;
}

// As it is shown, encoded.
vec3 eye_color(int eye, Source source) {
  return unscaled(source) ? eye_texel(eye, source) : srgb_from_linear(eye_light(eye, source));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy) - compose.place.xy;
  Source source = source_of_pixel(pixel, compose.place.zw);
  bool swapped = compose.mode.y != 0;
  vec3 color = vec3(0.0);
  if ((kVariant & AFM_FEATURE_MIXED) != 0u) {
    vec3 left = eye_light(swapped ? kRight : kLeft, source);
    vec3 right = eye_light(swapped ? kLeft : kRight, source);
    vec3 mixed = mat3(anaglyph.left[compose.mode.w]) * left + mat3(anaglyph.right[compose.mode.w]) * right;
    color = srgb_from_linear(clamp(mixed, 0.0, 1.0));
  } else if (source.eye != kBlank) {
    int eye = swapped ? kRight - source.eye : source.eye;
    color = (kVariant & AFM_FEATURE_SCALED) != 0u ? eye_color(eye, source) : eye_texel(eye, source);
  }
  out_color = vec4(color, 1.0);
}
