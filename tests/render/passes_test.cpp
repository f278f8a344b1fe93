// SPDX-License-Identifier: Apache-2.0
// Invariant: swapping the eyes swaps the pictures; multiview equals two passes byte for byte
#include <algorithm>

#include "support/pictures.h"
#include "support/vulkan_fixture.h"

namespace afm::test {
namespace passes_test {

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
  const auto first = renderer.read_composed({});
  renderer.render(frame);
  EXPECT_EQ(first.rgba, renderer.read_composed({}).rgba);
}

// Two frames in flight share targets and panels, and each slot is reused: only the newest frame is read.
TEST_F(Passes, FramesInFlightDoNotMix) {
  const auto last = full_frame(test_);
  auto renderer = make_renderer(test_.scene, small());
  for (int i = 0; i < 7; ++i) {
    auto earlier = last;
    earlier.bends.front().end_deflection = 0.02F * static_cast<float>(i);
    earlier.panels.force.content.cursor->place_nm = i;
    earlier.highlighted = {i % 2 == 0 ? test_.mica : test_.nitride};
    renderer.render(earlier);
  }
  renderer.render(last);
  const auto eyes = draw(test_.scene, last, small());
  EXPECT_EQ(renderer.read_eye(scene::Eye::Left).rgba, eyes.left.rgba);
  EXPECT_EQ(renderer.read_eye(scene::Eye::Right).rgba, eyes.right.rgba);
}

TEST_F(Passes, PicturesAreOpaque) {
  auto renderer = make_renderer(test_.scene, small());
  renderer.render(full_frame(test_));
  const auto image = renderer.read_composed({});
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    ASSERT_EQ(image.rgba[i], 255);
  }
}

}  // namespace passes_test
}  // namespace afm::test
