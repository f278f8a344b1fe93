// SPDX-License-Identifier: Apache-2.0
// Invariant: every stereo mode decodes to both eyes; shader and arithmetic agree in every pixel
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <string>

#include "support/anaglyph.h"
#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace compose_test {

using scene::EyeOrder;
using scene::PixelEye;
using scene::StereoMode;

constexpr std::array kOrders{EyeOrder::Straight, EyeOrder::Swapped};

class Compose : public VulkanTest {
 protected:
  static std::array<int, 3> rgb(const render::Image& image, glm::uvec2 at) { return rgb_at(image, at.x, at.y); }

  void render(render::PassMode passes = render::PassMode::Multiview) {
    renderer_.emplace(make_renderer(test_.scene, small(4, passes)));
    renderer_->render(full_frame(test_));
    left_ = renderer_->read_eye(scene::Eye::Left);
    right_ = renderer_->read_eye(scene::Eye::Right);
    ASSERT_NE(left_.rgba, right_.rgba);
  }

  const render::Image& seen(PixelEye eye) const { return eye == PixelEye::Left ? left_ : right_; }

  // Puts what a picture shows back into two eye images, and compares those with the eyes. Returns how many pixels of
  // the left and of the right eye were found.
  std::array<std::size_t, 2> decode(StereoMode mode, EyeOrder order, const render::Image& picture,
                                    const render::ReadArea& area) {
    std::map<std::array<unsigned, 3>, bool> found;
    std::size_t wrong = 0;
    for (unsigned y = 0; y < picture.height; ++y) {
      for (unsigned x = 0; x < picture.width; ++x) {
        const auto source =
            scene::source_of_pixel(mode, order, {picture.width, picture.height}, {x, y}, area.screen_px);
        const std::array shown = rgb(picture, {x, y});
        if (source.eye == PixelEye::Blank) {
          wrong += shown == std::array{0, 0, 0} ? 0U : 1U;
          continue;
        }
        const glm::uvec2 at(source.uv * glm::dvec2(left_.width, left_.height));
        wrong += shown == rgb(seen(source.eye), at) ? 0U : 1U;
        found[{source.eye == PixelEye::Left ? 0U : 1U, at.x, at.y}] = true;
      }
    }
    EXPECT_EQ(wrong, 0U) << scene::name_of(mode) << (order == EyeOrder::Swapped ? " swapped" : "");
    std::array<std::size_t, 2> counts{};
    for (const auto& [place, yes] : found) ++counts.at(place[0]);
    return counts;
  }

  TestScene test_ = make_test_scene();
  std::optional<render::Renderer> renderer_;
  render::Image left_, right_;
};

TEST_F(Compose, EveryModeWithoutFilteringDecodesBackByteForByte) {
  render();
  const std::size_t all = std::size_t{left_.width} * left_.height;
  const std::map<StereoMode, std::array<std::size_t, 2>> shares{{StereoMode::Mono, {all, 0}},
                                                                {StereoMode::Left, {all, 0}},
                                                                {StereoMode::Right, {0, all}},
                                                                {StereoMode::SideBySide, {all, all}},
                                                                {StereoMode::TopBottom, {all, all}},
                                                                {StereoMode::Row, {all / 2, all / 2}},
                                                                {StereoMode::Column, {all / 2, all / 2}},
                                                                {StereoMode::Checkerboard, {all / 2, all / 2}}};
  for (const auto& [mode, share] : shares) {
    for (const EyeOrder order : kOrders) {
      for (const glm::ivec2 screen_px : {glm::ivec2(0, 0), glm::ivec2(1, 0), glm::ivec2(0, 1), glm::ivec2(-7, 13)}) {
        const render::ReadArea area{.screen_px = screen_px};
        const auto found = decode(mode, order, renderer_->read_composed({mode, order}, area), area);
        const bool exchanged = order == EyeOrder::Swapped && mode != StereoMode::Mono;
        EXPECT_EQ(found[exchanged ? 1 : 0], share[0]) << scene::name_of(mode);
        EXPECT_EQ(found[exchanged ? 0 : 1], share[1]) << scene::name_of(mode);
      }
    }
  }
}

TEST_F(Compose, TwoPassesDecodeAsMultiviewDoes) {
  render(render::PassMode::TwoPasses);
  for (const StereoMode mode : {StereoMode::SideBySide, StereoMode::TopBottom, StereoMode::Checkerboard}) {
    decode(mode, EyeOrder::Straight, renderer_->read_composed({mode}), {});
  }
}

// Compares a whole picture with `expected` at each place of the eyes' images.
template <class Expected>
void expect_picture(const render::Image& picture, int tolerance, const Expected& expected) {
  int largest = 0;
  for (unsigned y = 0; y < picture.height; ++y) {
    for (unsigned x = 0; x < picture.width; ++x) {
      const Pixel p = pixel(picture, x, y);
      const std::array<int, 3> e = expected(x, y);
      largest = std::max({largest, std::abs(p.r - e[0]), std::abs(p.g - e[1]), std::abs(p.b - e[2])});
    }
  }
  EXPECT_LE(largest, tolerance);
}

TEST_F(Compose, HalfModesShowTheMeanLightOfTwoPixels) {
  render();
  for (const EyeOrder order : kOrders) {
    const auto mean = [&](unsigned x, unsigned y, glm::uvec2 step, bool second) {
      const render::Image& eye = seen((order == EyeOrder::Swapped) != second ? PixelEye::Right : PixelEye::Left);
      const auto a = rgb(eye, {x, y}), b = rgb(eye, glm::uvec2(x, y) + step);
      const glm::dvec3 light = 0.5 * (linear_light(a) + linear_light(b));
      return std::array<int, 3>{srgb8(light.x), srgb8(light.y), srgb8(light.z)};
    };
    expect_picture(renderer_->read_composed({StereoMode::SideBySideHalf, order}), 1,
                   [&](unsigned x, unsigned y) { return mean(2 * (x % 128), y, {1, 0}, x >= 128); });
    expect_picture(renderer_->read_composed({StereoMode::TopBottomHalf, order}), 1,
                   [&](unsigned x, unsigned y) { return mean(x, 2 * (y % 96), {0, 1}, y >= 96); });
  }
}

// One eye sees white everywhere and the other does not: of every mode, at sizes that nothing divides and anywhere on
// the screen, each pixel shows the eye that the layout says, and what it says belongs to none is black.
TEST_F(Compose, EveryPixelOfEveryModeShowsTheEyeOfTheLayout) {
  scene::Scene scene;
  const auto white = add_material(scene, {.name = "white", .unlit = true});
  add(scene, "wall", quad(white), glm::dmat4(glm::dmat3(6.0)));
  auto frame = bare_frame(scene);
  frame.eyes[1].view = glm::rotate(glm::dmat4(1.0), 2.0, glm::dvec3(0.0, 1.0, 0.0)) * frame.eyes[1].view;
  renderer_.emplace(make_renderer(scene, small(1)));
  renderer_->render(frame);
  for (const scene::StereoModeTraits& traits : scene::kStereoModes) {
    const StereoMode mode = traits.mode;
    if (scene::has_two_pictures(mode) || scene::anaglyph_matrices(mode)) continue;
    for (const EyeOrder order : kOrders) {
      const render::ReadArea area{.size_px = {61, 147}, .screen_px = {3, -2}};
      const auto picture = renderer_->read_composed({mode, order}, area);
      std::array<std::size_t, 4> wrong{};
      for (unsigned y = 0; y < picture.height; ++y) {
        for (unsigned x = 0; x < picture.width; ++x) {
          const auto source = scene::source_of_pixel(mode, order, area.size_px, {x, y}, area.screen_px);
          const int green = rgb(picture, {x, y})[1];
          const PixelEye shown = green > 240 ? PixelEye::Left : green > 0 ? PixelEye::Right : PixelEye::Blank;
          wrong.at(static_cast<std::size_t>(source.eye)) += shown == source.eye ? 0U : 1U;
        }
      }
      EXPECT_EQ(wrong, (std::array<std::size_t, 4>{})) << traits.name << (order == EyeOrder::Swapped ? " swapped" : "");
    }
  }
}

TEST_F(Compose, AnaglyphsAreTheMatricesInLinearLight) {
  render();
  for (const auto& entry : scene::kStereoModes) {
    const auto matrices = scene::anaglyph_matrices(entry.mode);
    if (!matrices) continue;
    for (const EyeOrder order : kOrders) {
      SCOPED_TRACE(entry.name);
      const bool swapped = order == EyeOrder::Swapped;
      expect_picture(renderer_->read_composed({entry.mode, order}), 1, [&](unsigned x, unsigned y) {
        const glm::dvec3 mixed =
            anaglyph_linear(*matrices, rgb(swapped ? right_ : left_, {x, y}), rgb(swapped ? left_ : right_, {x, y}));
        return std::array<int, 3>{srgb8(mixed.x), srgb8(mixed.y), srgb8(mixed.z)};
      });
    }
  }
}

TEST_F(Compose, TwoPicturesAreTheEyes) {
  render();
  for (const StereoMode mode : {StereoMode::QuadBuffer, StereoMode::Dual}) {
    const auto straight = renderer_->read_pair({mode});
    EXPECT_EQ(straight[0].rgba, left_.rgba);
    EXPECT_EQ(straight[1].rgba, right_.rgba);
    const auto swapped = renderer_->read_pair({mode, EyeOrder::Swapped});
    EXPECT_EQ(swapped[0].rgba, right_.rgba);
    EXPECT_EQ(swapped[1].rgba, left_.rgba);
  }
}

TEST_F(Compose, FramePackingHasItsLinesWhereTheStandardSays) {
  auto options = small(1);
  options.eye_width = 1280;
  options.eye_height = 720;
  renderer_.emplace(make_renderer(test_.scene, options));
  renderer_->render(bare_frame(test_.scene));
  left_ = renderer_->read_eye(scene::Eye::Left);
  right_ = renderer_->read_eye(scene::Eye::Right);
  const auto row = [](const render::Image& image, unsigned y) {
    const auto begin = image.rgba.begin() + std::ptrdiff_t{4} * image.width * y;
    return std::vector<std::uint8_t>(begin, begin + std::ptrdiff_t{4} * image.width);
  };
  std::vector<std::uint8_t> black;
  for (int i = 0; i < 1280; ++i) black.insert(black.end(), {0, 0, 0, 255});
  for (const EyeOrder order : kOrders) {
    const auto picture = renderer_->read_composed({StereoMode::FramePacked720p, order});
    ASSERT_EQ(picture.width, 1280U);
    ASSERT_EQ(picture.height, 1470U);
    std::size_t wrong = 0;
    for (unsigned y = 0; y < 1470; ++y) {
      const auto& upper = order == EyeOrder::Straight ? left_ : right_;
      const auto& lower = order == EyeOrder::Straight ? right_ : left_;
      const auto expected = y < 720 ? row(upper, y) : y < 750 ? black : row(lower, y - 750);
      wrong += row(picture, y) == expected ? 0U : 1U;
    }
    EXPECT_EQ(wrong, 0U);
  }
}

// Eyes of another size, as a projector's preview has them: the packing's lines stay where they are.
TEST_F(Compose, FramePackingOf1080LinesHasItsOwnSizeWhateverTheEyes) {
  render();
  const auto picture = renderer_->read_composed({StereoMode::FramePacked1080p});
  ASSERT_EQ(picture.width, 1920U);
  ASSERT_EQ(picture.height, 2205U);
  for (unsigned y = 1078; y < 1127; ++y) {
    const bool blank = y >= 1080 && y < 1125;
    std::size_t black = 0;
    for (unsigned x = 0; x < 1920; ++x) black += rgb(picture, {x, y}) == std::array{0, 0, 0} ? 1U : 0U;
    EXPECT_EQ(black == 1920, blank) << y;
  }
}

TEST_F(Compose, AKeystoneShiftsTheImageInsideItsHalfAndLeavesTheRestBlack) {
  render();
  // a quarter of the picture's width to the right: the output's place u shows the image's u - 1/4
  glm::dmat3 shift(1.0);
  shift[2][0] = -0.25;
  const auto shifted = renderer_->read_composed({StereoMode::SideBySide, EyeOrder::Straight, shift});
  expect_picture(shifted, 1, [&](unsigned x, unsigned y) {
    const unsigned in_half = x % 256;
    return in_half < 64 ? std::array{0, 0, 0} : rgb(x < 256 ? left_ : right_, {in_half - 64, y});
  });
}

// The corners of the image arrive where the homography sends them, in perspective.
TEST_F(Compose, AKeystoneIsProjective) {
  scene::Scene scene;
  const auto white = add_material(scene, {.name = "white", .unlit = true});
  add(scene, "wall", quad(white), glm::dmat4(glm::dmat3(6.0)));
  renderer_.emplace(make_renderer(scene, small()));
  renderer_->render(bare_frame(scene));
  // on the output: the unit square pinched at the top to 0.25..0.75; x = (u + 0.5 (v - 1) ...) solved by hand
  const glm::dmat3 output_from_picture =
      glm::transpose(glm::dmat3(1.0, -1.0, 1.0, 0.0, 0.0, 2.0, 0.0, -2.0, 4.0) / 4.0);
  const auto at = [&](glm::dvec2 p) {
    const glm::dvec3 q = output_from_picture * glm::dvec3(p, 1.0);
    return glm::dvec2(q) / q.z;
  };
  const std::array corners{at({0, 0}), at({1, 0}), at({1, 1}), at({0, 1})};
  const auto inside = [&](glm::dvec2 p) {
    double least = 1e9;
    for (std::size_t i = 0; i < 4; ++i) {
      const glm::dvec2 edge = corners.at((i + 1) % 4) - corners.at(i), to = p - corners.at(i);
      least = std::min(least, (edge.x * to.y - edge.y * to.x) / glm::length(edge));
    }
    return least;
  };
  const auto picture =
      renderer_->read_composed({StereoMode::Mono, EyeOrder::Straight, glm::inverse(output_from_picture)});
  std::size_t wrong = 0, lit = 0;
  for (unsigned y = 0; y < picture.height; ++y) {
    for (unsigned x = 0; x < picture.width; ++x) {
      const double depth = inside({(x + 0.5) / picture.width, (y + 0.5) / picture.height});
      const bool white_here = pixel(picture, x, y).g > 200;
      lit += white_here ? 1U : 0U;
      if (std::abs(depth) > 0.005) wrong += white_here == (depth > 0) ? 0U : 1U;
    }
  }
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(lit, 5000U);
}

TEST_F(Compose, OnePixelIsAPicture) {
  for (const auto& entry : scene::kStereoModes) {
    if (scene::has_two_pictures(entry.mode) || scene::frame_packing(entry.mode)) continue;
    const glm::uvec2 eye = scene::eye_size(entry.mode, {1, 1});
    auto options = small(1);
    options.eye_width = eye.x;
    options.eye_height = eye.y;
    auto renderer = make_renderer(test_.scene, options);
    renderer.render(bare_frame(test_.scene));
    const auto picture = renderer.read_composed({entry.mode}, {.size_px = {1, 1}});
    EXPECT_EQ(picture.width * picture.height, 1U) << entry.name;
    EXPECT_EQ(picture.rgba.at(3), 255) << entry.name;
  }
}

}  // namespace compose_test
}  // namespace afm::test
