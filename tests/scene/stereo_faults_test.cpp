// SPDX-License-Identifier: Apache-2.0
// The faults that were found in other programs, put back one by one: each property below must notice them. The
// properties count what breaks them; the program's own arithmetic breaks none.
// Invariant: the checks find every known fault of stereo programs when it is injected
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <random>

#include "scene/display/stereo_layout.h"
#include "scene/display/wall.h"
#include "support/anaglyph.h"
#include "support/stereo_cases.h"

namespace afm::scene {
namespace stereo_faults_test {

// ---- projections: a screen and both eyes give a view each ----

struct Viewing {
  Screen screen;
  std::array<glm::dvec3, 2> eyes;  // left and right eye
};
using Project = std::function<EyeView(const Viewing&, std::size_t eye)>;

EyeView ours(const Viewing& viewing, std::size_t eye) {
  return off_axis_view(viewing.screen, viewing.eyes[eye], DepthConvention::VulkanReversedInfinite, kNearM, 0.0).value();
}

glm::dvec2 ndc(const EyeView& view, const glm::dvec3& point) {
  const glm::dvec4 clip = view.projection * view.view * glm::dvec4(point, 1.0);
  return glm::dvec2(clip) / clip.w;
}

// Walls of any place and size; heads anywhere before them, level.
std::vector<Viewing> viewings() {
  std::mt19937 random(20261121);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::vector<Viewing> all;
  for (int i = 0; i < 300; ++i) {
    const glm::dquat turn = glm::normalize(glm::dquat(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)));
    const glm::dvec3 corner(uniform(-5, 5), uniform(-5, 5), uniform(-5, 5));
    const glm::dvec3 right = turn * glm::dvec3(uniform(0.3, 8), 0, 0), up = turn * glm::dvec3(0, uniform(0.3, 4), 0);
    const glm::dvec3 head = corner + turn * glm::dvec3(uniform(-2, 2), uniform(-2, 2), uniform(0.3, 6));
    const glm::dvec3 half = turn * glm::dvec3(0.5 * uniform(0.045, 0.08), 0, 0);
    all.push_back({{"any", corner, corner + right, corner + up}, {head - half, head + half}});
  }
  return all;
}

// The wall's corners fill both eyes' images; so a point on the wall has no parallax.
int wall_violations(const Project& project) {
  int violations = 0;
  for (const Viewing& viewing : viewings()) {
    const Screen& s = viewing.screen;
    const std::array corners{s.lower_left, s.lower_right, s.upper_left, s.upper_left + s.lower_right - s.lower_left};
    constexpr std::array kPlaces{glm::dvec2(-1, 1), glm::dvec2(1, 1), glm::dvec2(-1, -1), glm::dvec2(1, -1)};
    for (const std::size_t eye : {0U, 1U}) {
      const EyeView view = project(viewing, eye);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec2 off = ndc(view, corners[i]) - kPlaces[i];
        violations += glm::length(off) < 1e-9 ? 0 : 1;
      }
    }
  }
  return violations;
}

// Crossed before the wall, uncrossed behind it, never across the line of the eyes.
int parallax_violations(const Project& project) {
  int violations = 0;
  for (const Viewing& viewing : viewings()) {
    const EyeView left = project(viewing, 0), right = project(viewing, 1);
    for (const double z : {0.1, -0.1, -3.0}) {
      const glm::dvec2 parallax = ndc(right, viewing.screen.center() + z * viewing.screen.normal()) -
                                  ndc(left, viewing.screen.center() + z * viewing.screen.normal());
      violations += (parallax.x < 0) == (z > 0) ? 0 : 1;
      violations += std::abs(parallax.y) < 1e-9 ? 0 : 1;
    }
  }
  return violations;
}

// Only the diagonal term of y is turned round for Vulkan.
EyeView half_flipped(const Viewing& viewing, std::size_t eye) {
  EyeView view = ours(viewing, eye);
  view.projection[2][1] = -view.projection[2][1];
  return view;
}

// Assumes a shear that is a constant share of the eyes' distance, for any viewer.
EyeView constant_shear(const Viewing& viewing, std::size_t eye) {
  const glm::dvec3 middle = 0.5 * (viewing.eyes[0] + viewing.eyes[1]);
  EyeView view = off_axis_view(viewing.screen, middle, DepthConvention::VulkanReversedInfinite, kNearM, 0.0).value();
  const double shear = 0.8 * glm::distance(viewing.eyes[0], viewing.eyes[1]) / viewing.screen.width_m();
  view.projection[2][0] += (eye == 0 ? -1.0 : 1.0) * shear;
  return view;
}

// Assumes a viewer on the screen's axis.
EyeView on_axis(const Viewing& viewing, std::size_t eye) {
  const Screen& s = viewing.screen;
  const double distance = glm::dot(viewing.eyes[eye] - s.lower_left, s.normal());
  const glm::dvec3 offset = viewing.eyes[eye] - 0.5 * (viewing.eyes[0] + viewing.eyes[1]);
  const Viewing centred{s, {s.center() + distance * s.normal() + offset, s.center() + distance * s.normal() + offset}};
  EyeView view = ours(centred, eye);
  view.view = ours(viewing, eye).view;
  return view;
}

// View of cameras that both point at the middle of the wall.
EyeView toed_in(const Viewing& viewing, std::size_t eye) {
  const Screen& s = viewing.screen;
  const glm::dvec3 up = glm::normalize(s.upper_left - s.lower_left);
  EyeView view;
  const double distance = glm::distance(viewing.eyes[eye], s.center());
  const double x = 2.0 * distance / s.width_m(), y = 2.0 * distance / s.height_m();
  view.projection =
      glm::dmat4(glm::dvec4(x, 0, 0, 0), glm::dvec4(0, -y, 0, 0), glm::dvec4(0, 0, 0, -1), glm::dvec4(0, 0, kNearM, 0));
  view.view = glm::lookAtRH(viewing.eyes[eye], s.center(), up);
  return view;
}

EyeView exchanged(const Viewing& viewing, std::size_t eye) { return ours(viewing, 1 - eye); }

TEST(StereoFaults, OurProjectionHasNone) {
  EXPECT_EQ(wall_violations(ours), 0);
  EXPECT_EQ(parallax_violations(ours), 0);
}

TEST(StereoFaults, EveryWrongProjectionIsNoticed) {
  EXPECT_GT(wall_violations(half_flipped), 0) << "only P[1][1] flipped";
  EXPECT_GT(wall_violations(constant_shear), 0) << "constant shear";
  EXPECT_GT(wall_violations(on_axis), 0) << "viewer on the axis";
  EXPECT_GT(wall_violations(toed_in), 0) << "toe-in";
  EXPECT_GT(parallax_violations(toed_in), 0) << "toe-in: vertical parallax";
  EXPECT_GT(parallax_violations(exchanged), 0) << "eyes exchanged";
}

// ---- scale: the scene is scaled about a point of the wall, the room stays ----

// Positions of the eyes if the scene is shown `scale` times as large.
using Eyes = std::function<std::array<glm::dvec3, 2>(const HeadPose&, double ipd_m, double scale)>;

// However large the scene is shown, far away the images are as far apart on the wall as the eyes are.
int scale_violations(const Eyes& eyes) {
  const Screen screen{"wall", {-1.5, 0.4, 0}, {1.5, 0.4, 0}, {-1.5, 2.6, 0}};
  int violations = 0;
  for (const double scale : {1e-9, 0.1, 1.0, 30.0, 1e9}) {
    const auto at = eyes({.position_m = {0.2, 1.6, 2.5}}, 0.063, scale);
    const Viewing viewing{screen, at};
    const glm::dvec3 far(0.0, 1.5, -1e9);
    const double parallax_m = 0.5 * screen.width_m() * (ndc(ours(viewing, 1), far).x - ndc(ours(viewing, 0), far).x);
    violations += std::abs(parallax_m - 0.063) < 1e-6 ? 0 : 1;
  }
  return violations;
}

TEST(StereoFaults, EyesThatGrowWithTheSceneAreNoticed) {
  const auto both = [](const HeadPose& head, double ipd_m) {
    return std::array{eye_position(head, Eye::Left, ipd_m), eye_position(head, Eye::Right, ipd_m)};
  };
  EXPECT_EQ(scale_violations([&](const HeadPose& head, double ipd_m, double) { return both(head, ipd_m); }), 0);
  EXPECT_GT(
      scale_violations([&](const HeadPose& head, double ipd_m, double scale) { return both(head, ipd_m * scale); }), 0);
}

// ---- layouts: contents of each pixel ----

using Layout = std::function<PixelSource(StereoMode, glm::uvec2 picture, glm::uvec2 pixel, glm::ivec2 screen_px)>;

PixelSource our_layout(StereoMode mode, glm::uvec2 picture, glm::uvec2 pixel, glm::ivec2 screen_px) {
  return source_of_pixel(mode, EyeOrder::Straight, picture, pixel, screen_px);
}

// Side by side and top-bottom at full size show every pixel of both eyes, once.
int missing_pixels(const Layout& layout) {
  int violations = 0;
  for (const StereoMode mode : {StereoMode::SideBySide, StereoMode::TopBottom}) {
    const glm::uvec2 eye(16, 12), picture = picture_size(mode, eye);
    std::map<std::array<int, 3>, int> seen;
    for (unsigned y = 0; y < picture.y; ++y) {
      for (unsigned x = 0; x < picture.x; ++x) {
        const PixelSource source = layout(mode, picture, {x, y}, glm::ivec2(0));
        ++seen[{static_cast<int>(source.eye), static_cast<int>(std::floor(source.uv.x * eye.x)),
                static_cast<int>(std::floor(source.uv.y * eye.y))}];
      }
    }
    for (int y = 0; y < 12; ++y) {
      for (int x = 0; x < 16; ++x) {
        for (const PixelEye side : {PixelEye::Left, PixelEye::Right}) {
          violations += seen[{static_cast<int>(side), x, y}] == 1 ? 0 : 1;
        }
      }
    }
  }
  return violations;
}

// Counts the pixels of the screen whose eye changes when the window moves; 0 is right.
int wandering_parities(const Layout& layout) {
  int violations = 0;
  for (const StereoMode mode : {StereoMode::Row, StereoMode::Column, StereoMode::Checkerboard}) {
    for (int i = 0; i < 4; ++i) {
      const glm::ivec2 window(i & 1, i >> 1);
      const glm::ivec2 on_screen(10, 10);
      const auto moved = layout(mode, {32, 32}, glm::uvec2(on_screen - window), window);
      const auto still = layout(mode, {32, 32}, glm::uvec2(on_screen), glm::ivec2(0));
      violations += moved.eye == still.eye ? 0 : 1;
    }
  }
  return violations;
}

// Frame packing shows whole lines of the eyes whatever the picture's height.
int broken_lines(const Layout& layout) {
  int violations = 0;
  for (const unsigned height : {1470U, 1469U, 1000U, 735U}) {
    for (unsigned y = 0; y < height; ++y) {
      const PixelSource source = layout(StereoMode::FramePacked720p, {1280, height}, {0, y}, glm::ivec2(0));
      const double line = source.uv.y * 720 - 0.5;
      violations += source.eye == PixelEye::Blank || std::abs(line - std::round(line)) < 1e-6 ? 0 : 1;
    }
  }
  return violations;
}

TEST(StereoFaults, OurLayoutsHaveNone) {
  EXPECT_EQ(missing_pixels(our_layout), 0);
  EXPECT_EQ(wandering_parities(our_layout), 0);
  EXPECT_EQ(broken_lines(our_layout), 0);
}

TEST(StereoFaults, EveryWrongLayoutIsNoticed) {
  EXPECT_GT(missing_pixels([](StereoMode mode, glm::uvec2 picture, glm::uvec2 pixel, glm::ivec2 screen_px) {
              PixelSource source = our_layout(mode, picture, pixel, screen_px);
              if (source.eye == PixelEye::Right && mode == StereoMode::SideBySide) source.uv.x -= source.uv_per_pixel.x;
              return source;
            }),
            0)
      << "the right eye's viewport begins one column late";
  EXPECT_GT(wandering_parities([](StereoMode mode, glm::uvec2 picture, glm::uvec2 pixel, glm::ivec2) {
              return our_layout(mode, picture, pixel, glm::ivec2(0));
            }),
            0)
      << "parity follows the window";
  EXPECT_GT(broken_lines([](StereoMode, glm::uvec2 picture, glm::uvec2 pixel, glm::ivec2) {
              const double v = (pixel.y + 0.5) / picture.y;  // 24 of 49 parts are an eye, one is blank
              if (v < 24.0 / 49.0) return PixelSource{PixelEye::Left, {0.0, v * 49.0 / 24.0}};
              if (v < 25.0 / 49.0) return PixelSource{};
              return PixelSource{PixelEye::Right, {0.0, (v - 25.0 / 49.0) * 49.0 / 24.0}};
            }),
            0)
      << "frame packing by fractions of the height";
}

// ---- anaglyphs ----

using Mix = std::function<std::array<int, 3>(const std::array<int, 3>& left, const std::array<int, 3>& right)>;

// Rows of the research's red-cyan mixes that come out otherwise.
int wrong_colors(const Mix& mix) {
  int violations = 0;
  for (const test::StereoCase& row : test::stereo_cases("anaglyph")) {
    if (row.convention != "dubois_rc") continue;
    const auto color = [&](const std::vector<double>& v, std::size_t at) {
      return std::array<int, 3>{static_cast<int>(v[at]), static_cast<int>(v[at + 1]), static_cast<int>(v[at + 2])};
    };
    const auto mixed = mix(color(row.inputs, 0), color(row.inputs, 3)), expected = color(row.expected, 3);
    for (std::size_t i = 0; i < 3; ++i) violations += std::abs(mixed[i] - expected[i]) <= 1 ? 0 : 1;
  }
  return violations;
}

TEST(StereoFaults, EveryWrongAnaglyphIsNoticed) {
  const AnaglyphMatrices matrices = *anaglyph_matrices(StereoMode::AnaglyphRedCyan);
  EXPECT_EQ(wrong_colors([&](const auto& left, const auto& right) {
              const glm::dvec3 mixed = test::anaglyph_linear(matrices, left, right);
              return std::array{test::srgb8(mixed.x), test::srgb8(mixed.y), test::srgb8(mixed.z)};
            }),
            0);
  EXPECT_GT(wrong_colors([&](const auto& left, const auto& right) {
              const glm::dvec3 mixed = glm::clamp(matrices.left * glm::dvec3(left[0], left[1], left[2]) +
                                                      matrices.right * glm::dvec3(right[0], right[1], right[2]),
                                                  0.0, 255.0);
              return std::array{static_cast<int>(mixed.x), static_cast<int>(mixed.y), static_cast<int>(mixed.z)};
            }),
            0)
      << "matrices on encoded values";
  EXPECT_GT(wrong_colors([](const auto& left, const auto& right) { return std::array{left[0], right[1], right[2]}; }),
            0)
      << "colour masks";
}

}  // namespace stereo_faults_test
}  // namespace afm::scene
