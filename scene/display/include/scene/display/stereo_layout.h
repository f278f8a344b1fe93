// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

#include "core/result.h"

// How the two eyes' images become what a screen shows: pure arithmetic over pixels, counted from the top left corner.
namespace afm::scene {

enum class StereoMode {
  Mono,
  Left,
  Right,
  SideBySide,
  SideBySideHalf,
  TopBottom,
  TopBottomHalf,
  Row,
  Column,
  Checkerboard,
  AnaglyphRedCyan,
  AnaglyphGreenMagenta,
  AnaglyphAmberBlue,
  FramePacked720p,
  FramePacked1080p,
  QuadBuffer,
  Dual
};

struct NamedStereoMode {
  StereoMode mode;
  std::string_view name;
};

// Every mode with the name that a person writes for it, in the order of the enumeration.
inline constexpr std::array<NamedStereoMode, 17> kStereoModes{
    {{StereoMode::Mono, "mono"},
     {StereoMode::Left, "left"},
     {StereoMode::Right, "right"},
     {StereoMode::SideBySide, "side-by-side"},
     {StereoMode::SideBySideHalf, "side-by-side-half"},
     {StereoMode::TopBottom, "top-bottom"},
     {StereoMode::TopBottomHalf, "top-bottom-half"},
     {StereoMode::Row, "row"},
     {StereoMode::Column, "column"},
     {StereoMode::Checkerboard, "checkerboard"},
     {StereoMode::AnaglyphRedCyan, "anaglyph-red-cyan"},
     {StereoMode::AnaglyphGreenMagenta, "anaglyph-green-magenta"},
     {StereoMode::AnaglyphAmberBlue, "anaglyph-amber-blue"},
     {StereoMode::FramePacked720p, "frame-packed-720p"},
     {StereoMode::FramePacked1080p, "frame-packed-1080p"},
     {StereoMode::QuadBuffer, "quad-buffer"},
     {StereoMode::Dual, "dual"}}};

std::string_view name_of(StereoMode mode);

// WrongUsage, naming what there is: no mode of this name.
core::Result<StereoMode> parse_stereo_mode(std::string_view name);

// Swapped shows the right eye's image wherever the left eye's belongs, and the other way round.
enum class EyeOrder { Straight, Swapped };

// Lines of a frame-packed picture (HDMI 1.4a, 3D structure "frame packing"): left, blank, right.
struct FramePacking {
  glm::uvec2 eye_px;
  unsigned blank_lines;
};
std::optional<FramePacking> frame_packing(StereoMode mode);

// Quad-buffer and dual show each eye's image as a picture of its own: two; every other mode one.
bool has_two_pictures(StereoMode mode);

// Row, column and checkerboard: which eye a pixel belongs to counts from the screen's corner.
bool is_interleaved(StereoMode mode);

// Size of the picture (of each of them) in which one pixel of an eye image of `eye_px` is one pixel; the half modes
// squeeze two into one. Frame packing has a size of its own, whatever the eyes'.
glm::uvec2 picture_size(StereoMode mode, glm::uvec2 eye_px);

// The converse: eye images for a picture of `picture_px`, both at least 1 x 1. Where an odd number of pixels is shared
// by two eyes, the last stays blank.
glm::uvec2 eye_size(StereoMode mode, glm::uvec2 picture_px);

// What a pixel of a picture shows.
enum class PixelEye { Blank, Left, Right, Both };
struct PixelSource {
  PixelEye eye = PixelEye::Blank;
  glm::dvec2 uv{0.0};  // the middle of the pixel in the eye's image, of which the corners are 0,0 and 1,1
  glm::dvec2 uv_per_pixel{0.0};
};

// For a picture of `picture_px` whose first pixel is at `screen_px` of its screen: what is interleaved counts from the
// screen's corner, so that moving a window never exchanges the eyes. `pixel` counts from the picture's corner. For a
// mode with two pictures: of the first.
PixelSource source_of_pixel(StereoMode mode, EyeOrder order, glm::uvec2 picture_px, glm::uvec2 pixel,
                            glm::ivec2 screen_px = glm::ivec2(0));

// What glasses of two colours need: rgb = left * L + right * R in linear light, clamped to 0..1.
// Least-squares matrices of E. Dubois ("A projection method to generate anaglyph stereo images", ICASSP 2001; numbers
// of his "LeastSquaresHowToPhotoshop").
struct AnaglyphMatrices {
  glm::dmat3 left;
  glm::dmat3 right;
};
std::optional<AnaglyphMatrices> anaglyph_matrices(StereoMode mode);

}  // namespace afm::scene
