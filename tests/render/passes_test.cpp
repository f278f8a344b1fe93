// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace {

class Passes : public VulkanTest {
 protected:
  TestScene test_ = make_test_scene();
};

TEST_F(Passes, MultiviewEqualsTwoPassesByteForByteWithFourSamples) {
  const auto frame = full_frame(test_);
  const auto multiview = draw(test_.scene, frame, small(4, render::PassMode::Multiview));
  const auto two_passes = draw(test_.scene, frame, small(4, render::PassMode::TwoPasses));
  EXPECT_EQ(multiview.left.rgba, two_passes.left.rgba);
  EXPECT_EQ(multiview.right.rgba, two_passes.right.rgba);
  EXPECT_NE(multiview.left.rgba, multiview.right.rgba);
}

TEST_F(Passes, MultiviewEqualsTwoPassesByteForByteWithOneSample) {
  const auto frame = full_frame(test_);
  const auto multiview = draw(test_.scene, frame, small(1, render::PassMode::Multiview));
  const auto two_passes = draw(test_.scene, frame, small(1, render::PassMode::TwoPasses));
  EXPECT_EQ(multiview.left.rgba, two_passes.left.rgba);
  EXPECT_EQ(multiview.right.rgba, two_passes.right.rgba);
}

TEST_F(Passes, ThingsAcrossTheBorderOfThePictureAreSeenByBothEyes) {
  scene::Scene scene;
  const auto white = add_material(scene, {.name = "white", .unlit = true});
  add(scene, "larger than the wall", quad(white), glm::dmat4(glm::dmat3(6.0)));
  const auto eyes = draw(scene, bare_frame(scene), small());
  const auto is_white = [](const Pixel& p) { return p.g > 200; };
  EXPECT_EQ(count(eyes.left, is_white), std::size_t{256 * 192});
  EXPECT_EQ(count(eyes.right, is_white), std::size_t{256 * 192});
}

TEST_F(Passes, SwappingTheEyesSwapsThePicturesExactly) {
  auto frame = full_frame(test_);
  const auto straight = draw(test_.scene, frame, small());
  std::swap(frame.eyes[0], frame.eyes[1]);
  const auto swapped = draw(test_.scene, frame, small());
  EXPECT_EQ(straight.left.rgba, swapped.right.rgba);
  EXPECT_EQ(straight.right.rgba, swapped.left.rgba);
}

TEST_F(Passes, TheSameFrameGivesTheSameBytes) {
  const auto frame = full_frame(test_);
  auto renderer = make_renderer(test_.scene, small());
  renderer.render(frame);
  const auto first = renderer.read_composed(render::Layout::SideBySide);
  renderer.render(frame);
  EXPECT_EQ(first.rgba, renderer.read_composed(render::Layout::SideBySide).rgba);
}

// Two frames in flight share targets and panels, and each slot is reused: what is read is the newest frame alone.
TEST_F(Passes, FramesInFlightDoNotMix) {
  const auto last = full_frame(test_);
  auto renderer = make_renderer(test_.scene, small());
  for (int i = 0; i < 7; ++i) {
    auto earlier = last;
    earlier.bends.front().end_deflection = 0.02F * static_cast<float>(i);
    earlier.force_panel.cursor->z_nm = i;
    earlier.highlighted = {i % 2 == 0 ? test_.mica : test_.nitride};
    renderer.render(earlier);
  }
  renderer.render(last);
  const auto eyes = draw(test_.scene, last, small());
  EXPECT_EQ(renderer.read_eye(scene::Eye::Left).rgba, eyes.left.rgba);
  EXPECT_EQ(renderer.read_eye(scene::Eye::Right).rgba, eyes.right.rgba);
}

TEST_F(Passes, SideBySideDecodesBackToBothEyesByteForByte) {
  auto renderer = make_renderer(test_.scene, small());
  renderer.render(full_frame(test_));
  const auto composed = renderer.read_composed(render::Layout::SideBySide);
  ASSERT_EQ(composed.width, 512U);
  ASSERT_EQ(composed.height, 192U);
  render::Image left{.width = 256, .height = 192, .rgba = {}};
  render::Image right = left;
  for (std::uint32_t y = 0; y < composed.height; ++y) {
    const auto row = composed.rgba.begin() + std::ptrdiff_t{4} * 512 * y;
    left.rgba.insert(left.rgba.end(), row, row + 4 * 256);
    right.rgba.insert(right.rgba.end(), row + 4 * 256, row + 4 * 512);
  }
  EXPECT_EQ(left.rgba, renderer.read_eye(scene::Eye::Left).rgba);
  EXPECT_EQ(right.rgba, renderer.read_eye(scene::Eye::Right).rgba);
}

TEST_F(Passes, LeftAndRightLayoutsAreTheEyes) {
  auto renderer = make_renderer(test_.scene, small());
  renderer.render(full_frame(test_));
  EXPECT_EQ(renderer.read_composed(render::Layout::Left).rgba, renderer.read_eye(scene::Eye::Left).rgba);
  EXPECT_EQ(renderer.read_composed(render::Layout::Right).rgba, renderer.read_eye(scene::Eye::Right).rgba);
}

TEST_F(Passes, PicturesAreOpaque) {
  auto renderer = make_renderer(test_.scene, small());
  renderer.render(full_frame(test_));
  const auto image = renderer.read_composed(render::Layout::SideBySide);
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    ASSERT_EQ(image.rgba[i], 255);
  }
}

}  // namespace
}  // namespace afm::test
