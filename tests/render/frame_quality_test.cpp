// SPDX-License-Identifier: Apache-2.0
// Invariant: multiview equals two passes at every resolution and sample count
#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <tuple>
#include <utility>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace frame_quality_test {

class QualityOfFrames : public VulkanTest {
 protected:
  Pair eyes_of(render::Renderer& renderer, const render::FrameState& frame) const {
    renderer.render(frame);
    return {renderer.read_eye(scene::Eye::Left), renderer.read_eye(scene::Eye::Right)};
  }

  render::FrameState without_panels() const {
    render::FrameState bare = frame_;
    bare.panels = {};
    bare.labels.clear();
    return bare;
  }

  TestScene test_ = make_test_scene();
  render::FrameState frame_ = full_frame(test_);
};

// Each pixel of the half is within the four to which it is enlarged, which are blended with their neighbours.
TEST_F(QualityOfFrames, HalfTheResolutionIsThePictureOfAnEyeHalfAsLarge) {
  const render::FrameState frame = without_panels();
  auto half = small();
  half.eye_width /= 2;
  half.eye_height /= 2;
  auto renderer = make_renderer(test_.scene, small());
  renderer.set_quality({.scale = 0.5, .samples = 4});
  const auto scaled = eyes_of(renderer, frame);
  const auto smaller = draw(test_.scene, frame, half);
  for (const auto& [large, little] : {std::pair(&scaled.left, &smaller.left), {&scaled.right, &smaller.right}}) {
    ASSERT_EQ(large->width, small().eye_width);
    ASSERT_EQ(large->height, small().eye_height);
    for (std::uint32_t y = 1; y + 1 < little->height; ++y) {
      for (std::uint32_t x = 1; x + 1 < little->width; ++x) {
        // of four pixels at a quarter from the middle, the mean weighs the middle 9/16, an edge 3/32, a corner 1/64
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const auto at = [&](std::uint32_t i, std::uint32_t j) { return rgb_at(*little, i, j).at(channel); };
          const double blended =
              9.0 / 16.0 * at(x, y) + 3.0 / 32.0 * (at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1)) +
              1.0 / 64.0 * (at(x - 1, y - 1) + at(x + 1, y - 1) + at(x - 1, y + 1) + at(x + 1, y + 1));
          double mean = 0;
          for (const auto& [i, j] : {std::pair(0U, 0U), {1U, 0U}, {0U, 1U}, {1U, 1U}}) {
            mean += rgb_at(*large, 2 * x + i, 2 * y + j).at(channel) / 4.0;
          }
          ASSERT_NEAR(mean, blended, 1.5) << x << ", " << y;
        }
      }
    }
  }
}

// Texts on an opaque plate are the same to the byte, whatever the room behind them is drawn with.
TEST_F(QualityOfFrames, PanelsKeepAllTheirPixels) {
  for (const auto mode : {render::PassMode::Multiview, render::PassMode::TwoPasses}) {
    for (const std::uint32_t samples : {1U, 4U}) {
      auto options = small(1, mode);
      options.panel_contrast = render::PanelContrast::High;
      auto renderer = make_renderer(test_.scene, options);
      const auto whole = eyes_of(renderer, frame_);
      const auto bare = eyes_of(renderer, without_panels());
      options.samples = samples;
      auto reducing = make_renderer(test_.scene, options);
      reducing.set_quality({.scale = 0.5, .samples = samples});
      const auto reduced = eyes_of(reducing, frame_);
      const auto reduced_bare = eyes_of(reducing, without_panels());
      // a sharp pixel lies on a panel, and so do its neighbours, where no edge of panel or room is near
      std::size_t text = 0, differing = 0, room = 0;
      for (const auto& [sharp, none, other, other_none] :
           {std::tuple(&whole.left, &bare.left, &reduced.left, &reduced_bare.left),
            std::tuple(&whole.right, &bare.right, &reduced.right, &reduced_bare.right)}) {
        for (std::uint32_t y = 0; y < sharp->height; ++y) {
          for (std::uint32_t x = 0; x < sharp->width; ++x) {
            const Pixel p = pixel(*sharp, x, y);
            if (std::min({p.r, p.g, p.b}) > 200 && rgb_at(*sharp, x, y) != rgb_at(*none, x, y)) {
              ++text;
              differing += rgb_at(*sharp, x, y) != rgb_at(*other, x, y) ? 1U : 0U;
            }
            room += rgb_at(*none, x, y) != rgb_at(*other_none, x, y) ? 1U : 0U;
          }
        }
      }
      EXPECT_GT(text, 300U);
      EXPECT_LE(differing, text / 50);  // pixels at the edge of objects before a panel
      EXPECT_GT(room, 300U);            // pixels of the coarser room
    }
  }
}

TEST_F(QualityOfFrames, FewerSamplesAreThoseOfARendererMadeForFewer) {
  auto renderer = make_renderer(test_.scene, small(4));
  renderer.set_quality({.scale = 1.0, .samples = 1});
  const auto eyes = eyes_of(renderer, frame_);
  const auto single = draw(test_.scene, frame_, small(1));
  EXPECT_EQ(eyes.left.rgba, single.left.rgba);
  EXPECT_EQ(eyes.right.rgba, single.right.rgba);
}

TEST_F(QualityOfFrames, ComesBackWithoutATrace) {
  auto renderer = make_renderer(test_.scene, small());
  const auto before = eyes_of(renderer, frame_);
  for (const double scale : {0.5, 0.71, 0.001, 0.9}) {
    renderer.set_quality({.scale = scale, .samples = scale < 0.6 ? 1U : 4U});
    renderer.render(frame_);
  }
  renderer.set_quality({.scale = 1.0, .samples = 4});
  const auto after = eyes_of(renderer, frame_);
  EXPECT_EQ(before.left.rgba, after.left.rgba);
  EXPECT_EQ(before.right.rgba, after.right.rgba);
}

// The wall's geometry stays: a square keeps its place and size in the picture, to a pixel of the coarser one.
TEST_F(QualityOfFrames, ScalingBackUpPutsThingsWhereTheyWere) {
  scene::Scene scene;
  const auto white = add_material(scene, {.name = "white", .unlit = true});
  add(scene, "square", quad(white), glm::translate(glm::dmat4(1.0), glm::dvec3(0.7, -0.4, 0.3)));
  auto renderer = make_renderer(scene, small());
  const auto weight = brighter_than(120);
  renderer.render(bare_frame(scene));
  const auto whole = renderer.read_composed({.mode = scene::StereoMode::Right});
  renderer.set_quality({.scale = 0.5, .samples = 4});
  renderer.render(bare_frame(scene));
  const auto half = renderer.read_composed({.mode = scene::StereoMode::Right});
  ASSERT_EQ(half.width, whole.width);
  EXPECT_NEAR(centroid(half, weight)->x, centroid(whole, weight)->x, 1.0);
  EXPECT_NEAR(centroid(half, weight)->y, centroid(whole, weight)->y, 1.0);

  // nothing from beside the drawn part is shown
  for (std::uint32_t y = 0; y < half.height; ++y) {
    const std::size_t last = 4 * (std::size_t{y} * half.width + half.width - 1);
    ASSERT_NEAR(half.rgba[last], whole.rgba[last], 6) << y;
  }
}

TEST_F(QualityOfFrames, EyesThatSeeTheSameAreDrawnOnceAndShownTwice) {
  auto renderer = make_renderer(test_.scene, small());
  const auto stereo = eyes_of(renderer, frame_);
  auto one_eyed = frame_;
  one_eyed.eyes[1] = one_eyed.eyes[0];
  const auto same = eyes_of(renderer, one_eyed);
  const auto oracle = draw(test_.scene, one_eyed, small(4, render::PassMode::TwoPasses));
  EXPECT_EQ(same.left.rgba, oracle.left.rgba);
  EXPECT_EQ(same.right.rgba, oracle.left.rgba);
  EXPECT_EQ(renderer.read_composed({.mode = scene::StereoMode::Right}).rgba, oracle.left.rgba);

  // the right eye's picture is drawn again when it differs again
  EXPECT_EQ(eyes_of(renderer, frame_).right.rgba, stereo.right.rgba);
}

// From behind the head, past it, to the wall: clipped by the near planes of both eyes.
TEST_F(QualityOfFrames, WhatPassesBesideTheHeadIsSeenByBothEyes) {
  for (const std::uint32_t samples : {1U, 4U}) {
    scene::Scene scene;
    const auto white = add_material(scene, {.name = "white", .double_sided = true, .unlit = true});
    const glm::dmat4 flat = glm::rotate(glm::dmat4(1.0), glm::radians(-90.0), glm::dvec3(1.0, 0.0, 0.0));
    add(scene, "floor", quad(white),
        glm::translate(glm::dmat4(1.0), glm::dvec3(0.0, -0.5, 1.5)) * flat * glm::dmat4(glm::dmat3(6.0)));
    const auto frame = bare_frame(scene);
    const auto seen = draw(scene, frame, small(samples, render::PassMode::Automatic));
    const auto oracle = draw(scene, frame, small(samples, render::PassMode::TwoPasses));
    const auto is_white = [](const Pixel& p) { return p.g > 200; };
    EXPECT_GT(count(seen.left, is_white), std::size_t{256 * 192 / 8});
    EXPECT_EQ(count(seen.left, is_white), count(seen.right, is_white));
    EXPECT_EQ(seen.left.rgba, oracle.left.rgba);
    EXPECT_EQ(seen.right.rgba, oracle.right.rgba);
  }
}

}  // namespace frame_quality_test
}  // namespace afm::test
