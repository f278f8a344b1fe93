// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

#include "core/result.h"

// Layout of the two eye images on a screen: pure arithmetic on pixels, counted from the top left corner.
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
  Dual,
  Count
};

// Arrangement of the eye images in a picture; compose.frag has the same list. TwoPictures shows each eye image as a
// separate picture.
enum class EyeArrangement {
  Left,
  Right,
  TwoPictures,
  SideBySide,
  TopBottom,
  Rows,
  Columns,
  Checkerboard,
  Mixed,
  FramePacked
};

// Lines of a frame-packed picture (HDMI 1.4a, 3D structure "frame packing"): left, blank, right.
struct FramePacking {
  glm::uvec2 eye_px;
  unsigned blank_lines;
};

// Colour mix for anaglyph glasses: rgb = left * L + right * R in linear light, clamped to 0..1.
struct AnaglyphMatrices {
  glm::dmat3 left;
  glm::dmat3 right;
};

// Properties of a mode. A new mode needs a row here and, if its arrangement is new, a case in stereo_layout.cpp and one
// in compose.frag (docs/adding-a-stereo-mode.md).
struct StereoModeTraits {
  StereoMode mode;
  std::string_view name;  // name on the command line
  EyeArrangement arrangement;
  bool squeezed = false;     // two eyes share the size of one
  bool interleaved = false;  // the eye of a pixel depends on its position on the screen
  std::optional<FramePacking> packing{};
  std::optional<AnaglyphMatrices> anaglyph{};
};

// Matrix written row by row, as in print; GLM stores columns.
constexpr glm::dmat3 from_rows(const glm::dvec3& red, const glm::dvec3& green, const glm::dvec3& blue) {
  return {red.x, green.x, blue.x, red.y, green.y, blue.y, red.z, green.z, blue.z};
}

// Every mode, in the order of the enumeration. The anaglyphs are the least-squares matrices of E. Dubois ("A projection
// method to generate anaglyph stereo images", ICASSP 2001; numbers of his "LeastSquaresHowToPhotoshop").
inline constexpr auto kStereoModes = std::to_array<StereoModeTraits>({
    {.mode = StereoMode::Mono, .name = "mono", .arrangement = EyeArrangement::Left},
    {.mode = StereoMode::Left, .name = "left", .arrangement = EyeArrangement::Left},
    {.mode = StereoMode::Right, .name = "right", .arrangement = EyeArrangement::Right},
    {.mode = StereoMode::SideBySide, .name = "side-by-side", .arrangement = EyeArrangement::SideBySide},
    {.mode = StereoMode::SideBySideHalf,
     .name = "side-by-side-half",
     .arrangement = EyeArrangement::SideBySide,
     .squeezed = true},
    {.mode = StereoMode::TopBottom, .name = "top-bottom", .arrangement = EyeArrangement::TopBottom},
    {.mode = StereoMode::TopBottomHalf,
     .name = "top-bottom-half",
     .arrangement = EyeArrangement::TopBottom,
     .squeezed = true},
    {.mode = StereoMode::Row, .name = "row", .arrangement = EyeArrangement::Rows, .interleaved = true},
    {.mode = StereoMode::Column, .name = "column", .arrangement = EyeArrangement::Columns, .interleaved = true},
    {.mode = StereoMode::Checkerboard,
     .name = "checkerboard",
     .arrangement = EyeArrangement::Checkerboard,
     .interleaved = true},
    {.mode = StereoMode::AnaglyphRedCyan,
     .name = "anaglyph-red-cyan",
     .arrangement = EyeArrangement::Mixed,
     .anaglyph = AnaglyphMatrices{from_rows({0.437, 0.449, 0.164}, {-0.062, -0.062, -0.024}, {-0.048, -0.050, -0.017}),
                                  from_rows({-0.011, -0.032, -0.007}, {0.377, 0.761, 0.009}, {-0.026, -0.093, 1.234})}},
    {.mode = StereoMode::AnaglyphGreenMagenta,
     .name = "anaglyph-green-magenta",
     .arrangement = EyeArrangement::Mixed,
     .anaglyph = AnaglyphMatrices{from_rows({-0.062, -0.158, -0.039}, {0.284, 0.668, 0.143}, {-0.015, -0.027, 0.021}),
                                  from_rows({0.529, 0.705, 0.024}, {-0.016, -0.015, -0.065}, {0.009, 0.075, 0.937})}},
    {.mode = StereoMode::AnaglyphAmberBlue,
     .name = "anaglyph-amber-blue",
     .arrangement = EyeArrangement::Mixed,
     .anaglyph = AnaglyphMatrices{from_rows({1.062, -0.205, 0.299}, {-0.026, 0.908, 0.068}, {-0.038, -0.173, 0.022}),
                                  from_rows({-0.016, -0.123, -0.017}, {0.006, 0.062, -0.017}, {0.094, 0.185, 0.911})}},
    {.mode = StereoMode::FramePacked720p,
     .name = "frame-packed-720p",
     .arrangement = EyeArrangement::FramePacked,
     .packing = FramePacking{{1280, 720}, 30}},
    {.mode = StereoMode::FramePacked1080p,
     .name = "frame-packed-1080p",
     .arrangement = EyeArrangement::FramePacked,
     .packing = FramePacking{{1920, 1080}, 45}},
    {.mode = StereoMode::QuadBuffer, .name = "quad-buffer", .arrangement = EyeArrangement::TwoPictures},
    {.mode = StereoMode::Dual, .name = "dual", .arrangement = EyeArrangement::TwoPictures},
});
static_assert(kStereoModes.size() == static_cast<std::size_t>(StereoMode::Count), "a mode has no row");
static_assert([] {
  for (std::size_t i = 0; i < kStereoModes.size(); ++i) {
    const StereoModeTraits& row = kStereoModes[i];
    if (row.mode != static_cast<StereoMode>(i)) return false;
    if (row.packing.has_value() != (row.arrangement == EyeArrangement::FramePacked)) return false;
    if (row.anaglyph.has_value() != (row.arrangement == EyeArrangement::Mixed)) return false;
  }
  return true;
}());

constexpr const StereoModeTraits& traits_of(StereoMode mode) { return kStereoModes[static_cast<std::size_t>(mode)]; }
constexpr std::string_view name_of(StereoMode mode) { return traits_of(mode).name; }
constexpr bool is_interleaved(StereoMode mode) { return traits_of(mode).interleaved; }
constexpr const std::optional<FramePacking>& frame_packing(StereoMode mode) { return traits_of(mode).packing; }
constexpr const std::optional<AnaglyphMatrices>& anaglyph_matrices(StereoMode mode) { return traits_of(mode).anaglyph; }
constexpr bool has_two_pictures(StereoMode mode) { return traits_of(mode).arrangement == EyeArrangement::TwoPictures; }

// WrongUsage, with a list of the modes: no mode of this name.
core::Result<StereoMode> parse_stereo_mode(std::string_view name);

// Swapped exchanges the images of the left and the right eye.
enum class EyeOrder { Straight, Swapped };

// Size of the picture, or of each of two, in which a pixel of an eye image of `eye_px` is a pixel; the half modes
// squeeze two into one. Frame packing has a fixed size.
glm::uvec2 picture_size(StereoMode mode, glm::uvec2 eye_px);

// Inverse: size of the eye images for a picture of `picture_px`, at least 1 x 1. If two eyes share an odd number of
// pixels, the last one stays blank.
glm::uvec2 eye_size(StereoMode mode, glm::uvec2 picture_px);

// Eye whose image a pixel of a picture shows.
enum class PixelEye { Blank, Left, Right, Both };
struct PixelSource {
  PixelEye eye = PixelEye::Blank;
  glm::dvec2 uv{0.0};  // centre of the pixel in the eye's image, which has the corners 0,0 and 1,1
  glm::dvec2 uv_per_pixel{0.0};
};

// Source of a pixel in a picture of `picture_px` whose first pixel is at `screen_px` of its screen. Interleaving starts
// at the screen's corner, so that moving a window never exchanges the eyes. `pixel` starts at the picture's corner. In
// a mode with two pictures: of the first.
PixelSource source_of_pixel(StereoMode mode, EyeOrder order, glm::uvec2 picture_px, glm::uvec2 pixel,
                            glm::ivec2 screen_px = glm::ivec2(0));

}  // namespace afm::scene
