// SPDX-License-Identifier: Apache-2.0
#include "scene/display/stereo_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <string>

namespace afm::scene {

namespace {

// Of `whole` pixels that two eyes share.
unsigned share(unsigned whole) { return std::max(1U, whole / 2U); }

// A pixel of a region that shows one eye's image from corner to corner.
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

// Lines are whole numbers: a picture of another size shows the nearest line and column of the exact one.
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
  switch (mode) {
    case StereoMode::Mono:
    case StereoMode::Left:
    case StereoMode::QuadBuffer:
    case StereoMode::Dual:
      return in_region(PixelEye::Left, pixel, picture);
    case StereoMode::Right:
      return in_region(PixelEye::Right, pixel, picture);
    case StereoMode::SideBySide:
    case StereoMode::SideBySideHalf:
      return side_by_side(picture, pixel);
    case StereoMode::TopBottom:
    case StereoMode::TopBottomHalf:
      return top_bottom(picture, pixel);
    case StereoMode::Row:
      return in_region(interleaved(on_screen.y), pixel, picture);
    case StereoMode::Column:
      return in_region(interleaved(on_screen.x), pixel, picture);
    case StereoMode::Checkerboard:
      return in_region(interleaved(on_screen.x + on_screen.y), pixel, picture);
    case StereoMode::AnaglyphRedCyan:
    case StereoMode::AnaglyphGreenMagenta:
    case StereoMode::AnaglyphAmberBlue:
      return in_region(PixelEye::Both, pixel, picture);
    case StereoMode::FramePacked720p:
    case StereoMode::FramePacked1080p:
      return frame_packed(*frame_packing(mode), picture, pixel);
  }
  return {};
}

// Written row by row, as in print; GLM stores columns.
glm::dmat3 rows(const glm::dvec3& red, const glm::dvec3& green, const glm::dvec3& blue) {
  return glm::transpose(glm::dmat3(red, green, blue));
}

}  // namespace

std::string_view name_of(StereoMode mode) { return kStereoModes[static_cast<std::size_t>(mode)].name; }

core::Result<StereoMode> parse_stereo_mode(std::string_view name) {
  std::string known;
  for (const NamedStereoMode& entry : kStereoModes) {
    if (entry.name == name) return entry.mode;
    known += known.empty() ? std::string(entry.name) : ", " + std::string(entry.name);
  }
  return core::failure(core::ErrorCategory::WrongUsage,
                       fmt::format("\"{}\" is not a stereo mode; there are {}", name, known));
}

std::optional<FramePacking> frame_packing(StereoMode mode) {
  if (mode == StereoMode::FramePacked720p) return FramePacking{{1280, 720}, 30};
  if (mode == StereoMode::FramePacked1080p) return FramePacking{{1920, 1080}, 45};
  return std::nullopt;
}

bool has_two_pictures(StereoMode mode) { return mode == StereoMode::QuadBuffer || mode == StereoMode::Dual; }

bool is_interleaved(StereoMode mode) {
  return mode == StereoMode::Row || mode == StereoMode::Column || mode == StereoMode::Checkerboard;
}

glm::uvec2 picture_size(StereoMode mode, glm::uvec2 eye_px) {
  if (const auto packing = frame_packing(mode)) {
    return {packing->eye_px.x, 2U * packing->eye_px.y + packing->blank_lines};
  }
  if (mode == StereoMode::SideBySide) return {2U * eye_px.x, eye_px.y};
  if (mode == StereoMode::TopBottom) return {eye_px.x, 2U * eye_px.y};
  return eye_px;
}

glm::uvec2 eye_size(StereoMode mode, glm::uvec2 picture_px) {
  if (const auto packing = frame_packing(mode)) return packing->eye_px;
  if (mode == StereoMode::SideBySide) return {share(picture_px.x), picture_px.y};
  if (mode == StereoMode::TopBottom) return {picture_px.x, share(picture_px.y)};
  return picture_px;
}

PixelSource source_of_pixel(StereoMode mode, EyeOrder order, glm::uvec2 picture_px, glm::uvec2 pixel,
                            glm::ivec2 screen_px) {
  PixelSource source = straight_source(mode, picture_px, pixel, screen_px);
  // what both eyes see in mono is one image, so there is nothing to exchange
  if (order == EyeOrder::Swapped && mode != StereoMode::Mono) source.eye = other(source.eye);
  return source;
}

std::optional<AnaglyphMatrices> anaglyph_matrices(StereoMode mode) {
  switch (mode) {
    case StereoMode::AnaglyphRedCyan:
      return AnaglyphMatrices{rows({0.437, 0.449, 0.164}, {-0.062, -0.062, -0.024}, {-0.048, -0.050, -0.017}),
                              rows({-0.011, -0.032, -0.007}, {0.377, 0.761, 0.009}, {-0.026, -0.093, 1.234})};
    case StereoMode::AnaglyphGreenMagenta:
      return AnaglyphMatrices{rows({-0.062, -0.158, -0.039}, {0.284, 0.668, 0.143}, {-0.015, -0.027, 0.021}),
                              rows({0.529, 0.705, 0.024}, {-0.016, -0.015, -0.065}, {0.009, 0.075, 0.937})};
    case StereoMode::AnaglyphAmberBlue:
      return AnaglyphMatrices{rows({1.062, -0.205, 0.299}, {-0.026, 0.908, 0.068}, {-0.038, -0.173, 0.022}),
                              rows({-0.016, -0.123, -0.017}, {0.006, 0.062, -0.017}, {0.094, 0.185, 0.911})};
    default:
      return std::nullopt;
  }
}

}  // namespace afm::scene
