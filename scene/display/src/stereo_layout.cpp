// SPDX-License-Identifier: Apache-2.0
#include "scene/display/stereo_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <string>

namespace afm::scene {

namespace {

// Pixels per eye if two eyes share `whole` pixels.
unsigned share(unsigned whole) { return std::max(1U, whole / 2U); }

// Pixel of a region that shows one eye's image from corner to corner.
PixelSource in_region(PixelEye eye, glm::uvec2 pixel, glm::uvec2 region_px) {
  return {eye, (glm::dvec2(pixel) + 0.5) / glm::dvec2(region_px), 1.0 / glm::dvec2(region_px)};
}

PixelSource side_by_side(glm::uvec2 picture, glm::uvec2 pixel) {
  const glm::uvec2 region(share(picture.x), picture.y);
  if (pixel.x < region.x) return in_region(PixelEye::Left, pixel, region);
  if (pixel.x < 2U * region.x) return in_region(PixelEye::Right, pixel - glm::uvec2(region.x, 0), region);
  return {};
}

PixelSource top_bottom(glm::uvec2 picture, glm::uvec2 pixel) {
  const glm::uvec2 region(picture.x, share(picture.y));
  if (pixel.y < region.y) return in_region(PixelEye::Left, pixel, region);
  if (pixel.y < 2U * region.y) return in_region(PixelEye::Right, pixel - glm::uvec2(0, region.y), region);
  return {};
}

// Lines are integers: a picture of another size shows the nearest line and column of the exact one.
PixelSource frame_packed(const FramePacking& packing, glm::uvec2 picture, glm::uvec2 pixel) {
  const unsigned right_begins = packing.eye_px.y + packing.blank_lines;
  const glm::dvec2 scale = glm::dvec2(packing.eye_px.x, right_begins + packing.eye_px.y) / glm::dvec2(picture);
  const glm::uvec2 exact((glm::dvec2(pixel) + 0.5) * scale);
  if (exact.y >= packing.eye_px.y && exact.y < right_begins) return {};
  const bool left = exact.y < packing.eye_px.y;
  PixelSource source = in_region(left ? PixelEye::Left : PixelEye::Right,
                                 left ? exact : exact - glm::uvec2(0, right_begins), packing.eye_px);
  source.uv_per_pixel *= scale;
  return source;
}

PixelEye interleaved(int position) { return (position & 1) == 0 ? PixelEye::Left : PixelEye::Right; }

PixelEye other(PixelEye eye) {
  if (eye == PixelEye::Left) return PixelEye::Right;
  if (eye == PixelEye::Right) return PixelEye::Left;
  return eye;
}

PixelSource straight_source(StereoMode mode, glm::uvec2 picture, glm::uvec2 pixel, glm::ivec2 screen_px) {
  const glm::ivec2 on_screen = screen_px + glm::ivec2(pixel);
  switch (traits_of(mode).arrangement) {
    case EyeArrangement::Left:
    case EyeArrangement::TwoPictures:
      return in_region(PixelEye::Left, pixel, picture);
    case EyeArrangement::Right:
      return in_region(PixelEye::Right, pixel, picture);
    case EyeArrangement::SideBySide:
      return side_by_side(picture, pixel);
    case EyeArrangement::TopBottom:
      return top_bottom(picture, pixel);
    case EyeArrangement::Rows:
      return in_region(interleaved(on_screen.y), pixel, picture);
    case EyeArrangement::Columns:
      return in_region(interleaved(on_screen.x), pixel, picture);
    case EyeArrangement::Checkerboard:
      return in_region(interleaved(on_screen.x + on_screen.y), pixel, picture);
    case EyeArrangement::Mixed:
      return in_region(PixelEye::Both, pixel, picture);
    case EyeArrangement::FramePacked:
      return frame_packed(*frame_packing(mode), picture, pixel);
  }
  return {};
}

// Number of eye images side by side in the picture, in each direction.
glm::uvec2 eyes_in_picture(const StereoModeTraits& mode) {
  if (mode.squeezed) return {1, 1};
  return {mode.arrangement == EyeArrangement::SideBySide ? 2U : 1U,
          mode.arrangement == EyeArrangement::TopBottom ? 2U : 1U};
}

}  // namespace

core::Result<StereoMode> parse_stereo_mode(std::string_view name) {
  std::string known;
  for (const StereoModeTraits& entry : kStereoModes) {
    if (entry.name == name) return entry.mode;
    known += known.empty() ? std::string(entry.name) : ", " + std::string(entry.name);
  }
  return core::failure(core::ErrorCategory::WrongUsage,
                       fmt::format("\"{}\" is not a stereo mode; choose {}", name, known));
}

glm::uvec2 picture_size(StereoMode mode, glm::uvec2 eye_px) {
  if (const auto& packing = frame_packing(mode)) {
    return {packing->eye_px.x, 2U * packing->eye_px.y + packing->blank_lines};
  }
  return eyes_in_picture(traits_of(mode)) * eye_px;
}

glm::uvec2 eye_size(StereoMode mode, glm::uvec2 picture_px) {
  if (const auto& packing = frame_packing(mode)) return packing->eye_px;
  return glm::max(picture_px / eyes_in_picture(traits_of(mode)), 1U);
}

PixelSource source_of_pixel(StereoMode mode, EyeOrder order, glm::uvec2 picture_px, glm::uvec2 pixel,
                            glm::ivec2 screen_px) {
  PixelSource source = straight_source(mode, picture_px, pixel, screen_px);
  // both eyes see the same image in mono, so there is nothing to exchange
  if (order == EyeOrder::Swapped && mode != StereoMode::Mono) source.eye = other(source.eye);
  return source;
}

}  // namespace afm::scene
