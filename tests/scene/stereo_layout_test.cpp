// SPDX-License-Identifier: Apache-2.0
// Invariant: interleaving counts from the screen, not the window
#include "scene/display/stereo_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <set>

#include "support/anaglyph.h"
#include "support/stereo_cases.h"

namespace afm::scene {
namespace stereo_layout_test {

using test::StereoCase;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string case_name(const ::testing::TestParamInfo<StereoCase>& info) { return info.param.id; }

// ---- the research's rows ----

StereoMode mode_of(const std::string& name) {
  static const std::map<std::string, StereoMode> modes{{"mono", StereoMode::Mono},
                                                       {"sbs_half", StereoMode::SideBySideHalf},
                                                       {"sbs_full", StereoMode::SideBySide},
                                                       {"span_lr", StereoMode::SideBySide},
                                                       {"tb_half", StereoMode::TopBottomHalf},
                                                       {"tb_full", StereoMode::TopBottom},
                                                       {"row", StereoMode::Row},
                                                       {"col", StereoMode::Column},
                                                       {"checker", StereoMode::Checkerboard},
                                                       {"framepack_1080", StereoMode::FramePacked1080p},
                                                       {"framepack_720", StereoMode::FramePacked720p}};
  return modes.at(name);
}

class LayoutRow : public ::testing::TestWithParam<StereoCase> {};

TEST_P(LayoutRow, ShowsThatPlaceOfThatEye) {
  const std::vector<double>& in = GetParam().inputs;
  const std::vector<double>& expected = GetParam().expected;
  const glm::uvec2 picture(in[0], in[1]);
  const PixelSource source =
      source_of_pixel(mode_of(GetParam().convention), in[4] != 0 ? EyeOrder::Swapped : EyeOrder::Straight, picture,
                      glm::uvec2(in[2], in[3]));
  const PixelEye eye = expected[0] < 0 ? PixelEye::Blank : expected[0] == 0 ? PixelEye::Left : PixelEye::Right;
  EXPECT_EQ(source.eye, eye);
  EXPECT_NEAR(source.uv.x, expected[1], 1e-9);
  EXPECT_NEAR(source.uv.y, expected[2], 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Stereo, LayoutRow, ::testing::ValuesIn(test::stereo_cases("layout")), case_name);

glm::dmat3 same_rows(const glm::dvec3& red, const glm::dvec3& green, const glm::dvec3& blue) {
  return glm::transpose(glm::dmat3(red, green, blue));
}

// The research compares with matrices that the program does not offer: they check the rule, the program's own check its
// numbers.
AnaglyphMatrices matrices_of(const std::string& name) {
  constexpr glm::dvec3 kNone(0.0), kGrey(0.2126, 0.7152, 0.0722);
  if (name == "dubois_rc") return *anaglyph_matrices(StereoMode::AnaglyphRedCyan);
  if (name == "dubois_gm") return *anaglyph_matrices(StereoMode::AnaglyphGreenMagenta);
  if (name == "dubois_ab") return *anaglyph_matrices(StereoMode::AnaglyphAmberBlue);
  if (name == "dubois_rc_crt") {
    return {
        same_rows({.456100, .500484, .176381}, {-.0400822, -.0378246, -.0157589}, {-.0152161, -.0205971, -.00546856}),
        same_rows({-.0434706, -.0879388, -.00155529}, {.378476, .73364, -.0184503}, {-.0721527, -.112961, 1.2264})};
  }
  const glm::dmat3 cyan = same_rows(kNone, {0, 1, 0}, {0, 0, 1});
  if (name == "full_rc") return {same_rows({1, 0, 0}, kNone, kNone), cyan};
  if (name == "half_rc") return {same_rows(kGrey, kNone, kNone), cyan};
  if (name == "gray_rc") return {same_rows(kGrey, kNone, kNone), same_rows(kNone, kGrey, kGrey)};
  std::abort();
}

class AnaglyphRow : public ::testing::TestWithParam<StereoCase> {};

TEST_P(AnaglyphRow, MixesInLinearLight) {
  const std::vector<double>& in = GetParam().inputs;
  const std::vector<double>& expected = GetParam().expected;
  const auto color = [&](std::size_t at) {
    return std::array<int, 3>{static_cast<int>(in[at]), static_cast<int>(in[at + 1]), static_cast<int>(in[at + 2])};
  };
  const glm::dvec3 linear = test::anaglyph_linear(matrices_of(GetParam().convention), color(0), color(3));
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(linear[i], expected[static_cast<std::size_t>(i)], 1e-6);
    EXPECT_NEAR(test::srgb8(linear[i]), expected[static_cast<std::size_t>(i) + 3], 1.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Stereo, AnaglyphRow, ::testing::ValuesIn(test::stereo_cases("anaglyph")), case_name);

TEST(ResearchLayouts, WereAllRead) {
  EXPECT_EQ(test::stereo_cases("layout").size(), 38U);
  EXPECT_EQ(test::stereo_cases("anaglyph").size(), 28U);
}

// ---- properties ----

TEST(StereoModes, HaveNamesThatReadBack) {
  std::set<std::string_view> names;
  for (std::size_t i = 0; i < kStereoModes.size(); ++i) {
    EXPECT_EQ(parse_stereo_mode(kStereoModes[i].name).value(), kStereoModes[i].mode);
    EXPECT_EQ(name_of(kStereoModes[i].mode), kStereoModes[i].name);
    names.insert(kStereoModes[i].name);
  }
  EXPECT_EQ(names.size(), kStereoModes.size());
}

TEST(StereoModes, NamesTheLegalOnesForAnUnknownOne) {
  for (const char* wrong : {"", "Mono", "side by side", "anaglyph", "mono "}) {
    const auto mode = parse_stereo_mode(wrong);
    ASSERT_FALSE(mode.has_value()) << wrong;
    EXPECT_EQ(mode.error().category, core::ErrorCategory::WrongUsage);
    for (const StereoModeTraits& entry : kStereoModes)
      EXPECT_THAT(mode.error().message, HasSubstr(std::string(entry.name)));
  }
}

TEST(StereoModes, WhiteStaysWhiteBehindEveryPairOfGlasses) {
  for (const StereoModeTraits& entry : kStereoModes) {
    const auto matrices = anaglyph_matrices(entry.mode);
    EXPECT_EQ(matrices.has_value(), entry.name.starts_with("anaglyph")) << entry.name;
    if (!matrices) continue;
    const glm::dvec3 white = matrices->left * glm::dvec3(1.0) + matrices->right * glm::dvec3(1.0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(white[i], 1.0, 0.0011) << entry.name;
  }
}

constexpr std::array kSizes{glm::uvec2{1, 1}, glm::uvec2{1, 7}, glm::uvec2{2, 2}, glm::uvec2{31, 17},
                            glm::uvec2{64, 48}};

TEST(StereoLayout, EveryPixelOfEachEyeIsShownOnceWhereOnePixelIsOne) {
  for (const StereoMode mode : {StereoMode::SideBySide, StereoMode::TopBottom}) {
    for (const glm::uvec2 eye : kSizes) {
      const glm::uvec2 picture = picture_size(mode, eye);
      EXPECT_EQ(eye_size(mode, picture), eye);
      std::map<std::array<unsigned, 3>, int> seen;
      for (unsigned y = 0; y < picture.y; ++y) {
        for (unsigned x = 0; x < picture.x; ++x) {
          const PixelSource source = source_of_pixel(mode, EyeOrder::Straight, picture, {x, y});
          ++seen[{source.eye == PixelEye::Left ? 0U : 1U, static_cast<unsigned>(source.uv.x * eye.x),
                  static_cast<unsigned>(source.uv.y * eye.y)}];
        }
      }
      EXPECT_EQ(seen.size(), std::size_t{2} * eye.x * eye.y);
      for (const auto& [place, times] : seen) EXPECT_EQ(times, 1);
    }
  }
}

TEST(StereoLayout, SwappingExchangesTheEyesOfEveryPixelAndNothingElse) {
  for (const StereoModeTraits& entry : kStereoModes) {
    const glm::uvec2 picture = frame_packing(entry.mode) ? picture_size(entry.mode, {1, 1}) : glm::uvec2(12, 10);
    for (unsigned y = 0; y < picture.y; ++y) {
      for (unsigned x = 0; x < picture.x; x += 5) {
        const PixelSource straight = source_of_pixel(entry.mode, EyeOrder::Straight, picture, {x, y});
        const PixelSource swapped = source_of_pixel(entry.mode, EyeOrder::Swapped, picture, {x, y});
        ASSERT_EQ(straight.uv, swapped.uv) << entry.name;
        const bool one_image =
            straight.eye == PixelEye::Blank || straight.eye == PixelEye::Both || entry.mode == StereoMode::Mono;
        ASSERT_EQ(straight.eye == swapped.eye, one_image) << entry.name << ' ' << x << ' ' << y;
      }
    }
  }
}

// A window that is moved shows the same eye in the same pixel of the screen.
TEST(StereoLayout, ParityBelongsToTheScreenAndNotToTheWindow) {
  for (const StereoMode mode : {StereoMode::Row, StereoMode::Column, StereoMode::Checkerboard}) {
    EXPECT_TRUE(is_interleaved(mode));
    for (int left = -3; left <= 3; ++left) {
      for (int top = -3; top <= 3; ++top) {
        for (int y = 4; y < 8; ++y) {
          for (int x = 4; x < 8; ++x) {
            const auto at = [&](int window_left, int window_top) {
              return source_of_pixel(mode, EyeOrder::Straight, {16, 16}, glm::uvec2(x - window_left, y - window_top),
                                     {window_left, window_top})
                  .eye;
            };
            ASSERT_EQ(at(left, top), at(0, 0)) << name_of(mode);
          }
        }
      }
    }
  }
}

TEST(StereoLayout, AnOddPixelThatTwoEyesWouldShareStaysBlank) {
  EXPECT_EQ(eye_size(StereoMode::SideBySide, {7, 5}), glm::uvec2(3, 5));
  EXPECT_EQ(source_of_pixel(StereoMode::SideBySide, EyeOrder::Straight, {7, 5}, {6, 0}).eye, PixelEye::Blank);
  EXPECT_EQ(eye_size(StereoMode::TopBottom, {5, 7}), glm::uvec2(5, 3));
  EXPECT_EQ(source_of_pixel(StereoMode::TopBottomHalf, EyeOrder::Straight, {5, 7}, {0, 6}).eye, PixelEye::Blank);
  EXPECT_EQ(eye_size(StereoMode::SideBySide, {1, 1}), glm::uvec2(1, 1));
}

// In a window of another size frame packing keeps its proportions, and the lines between the eyes stay blank.
TEST(StereoLayout, FramePackingScaledIsStillLeftBlankRight) {
  for (const StereoMode mode : {StereoMode::FramePacked720p, StereoMode::FramePacked1080p}) {
    const glm::uvec2 picture = picture_size(mode, {3, 3}) / 3U;
    std::vector<PixelEye> order;
    for (unsigned y = 0; y < picture.y; ++y) {
      const PixelEye eye = source_of_pixel(mode, EyeOrder::Straight, picture, {picture.x / 2, y}).eye;
      if (order.empty() || order.back() != eye) order.push_back(eye);
    }
    EXPECT_THAT(order, ::testing::ElementsAre(PixelEye::Left, PixelEye::Blank, PixelEye::Right));
  }
}

}  // namespace stereo_layout_test
}  // namespace afm::scene
